#include "tests/support/counted_allocations.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace support {

std::atomic<long> g_allocations{0};

namespace {

void* countedAllocation(std::size_t size, std::size_t alignment) noexcept {
  ++g_allocations;
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void* orThrow(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

}  // namespace
}  // namespace support

// The compiler cannot see that both sides are replaced together.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

void* operator new(std::size_t size) {
  return support::orThrow(support::countedAllocation(size, alignof(std::max_align_t)));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return support::orThrow(support::countedAllocation(size, static_cast<std::size_t>(alignment)));
}
// Without it the temporary buffers of std::stable_sort would come from elsewhere and be freed here.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return support::countedAllocation(size, alignof(std::max_align_t));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
