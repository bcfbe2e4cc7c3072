#include "pfx/base_level/memory/block_memory.h"

#include <bit>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>

namespace pfx {
namespace {

thread_local BlockMemory* current_memory = nullptr;

constexpr size_t kSteps = 4;  // classes to a doubling, and those below the first

class Locked {
 public:
  explicit Locked(MemoryLock* lock) : lock_(lock) {
    if (lock_ != nullptr) lock_->lock();
  }
  ~Locked() {
    if (lock_ != nullptr) lock_->unlock();
  }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  MemoryLock* lock_;
};

void* fromHeap(size_t bytes) { return ::operator new(bytes, std::align_val_t{BlockMemory::kAlignment}); }

}  // namespace

BlockMemory* currentMemory() { return current_memory; }

MemoryScope::MemoryScope(BlockMemory* memory) : before_(current_memory) { current_memory = memory; }
MemoryScope::~MemoryScope() { current_memory = before_; }

void BlockMemory::requireAligned(std::span<const std::byte> block) {
  if (reinterpret_cast<uintptr_t>(block.data()) % kAlignment != 0)
    throw std::invalid_argument("memory: the block is not aligned to " + std::to_string(kAlignment) + " bytes");
}

BlockMemory::BlockMemory(std::span<std::byte> block, MemoryLock* lock) : block_(block), has_block_(true), lock_(lock) {
  requireAligned(block);
}

// Classes 0 to 3 hold 1 to 4 units of the alignment, the next four 5, 6, 7 and 8 of them, then 10, 12, 14, 16, ...
size_t BlockMemory::classOf(size_t bytes) {
  const size_t units = bytes == 0 ? 1 : (bytes - 1) / kAlignment + 1;
  if (units <= kSteps) return units - 1;
  const auto doublings = static_cast<size_t>(std::bit_width(units - 1)) - 3;  // of the step of one unit
  return kSteps * doublings + ((units - 1) >> doublings);
}

size_t BlockMemory::sizeOf(size_t size_class) {
  if (size_class < kSteps) return (size_class + 1) * kAlignment;
  const size_t doublings = (size_class - kSteps) / kSteps, step = size_class % kSteps;
  return ((kSteps + step + 1) << doublings) * kAlignment;
}

void* BlockMemory::allocate(size_t bytes) {
  const size_t size_class = classOf(bytes), size = sizeOf(size_class);
  if (size_class >= kClasses) throw std::bad_alloc();
  const Locked locked(lock_);
  SizeClass& c = classes_[size_class];
  if (c.in_block != nullptr) {
    void* place = c.in_block;
    c.in_block = c.in_block->next;
    return place;
  }
  if (c.elsewhere > 0) {
    void* place = fromHeap(size);
    --c.elsewhere;
    return place;
  }
  const size_t begin = top_;
  void* place = has_block_ && begin + size <= block_.size() ? block_.data() + begin : fromHeap(size);
  top_ += size;
  return place;
}

void BlockMemory::deallocate(void* place, size_t bytes) noexcept {
  const Locked locked(lock_);
  SizeClass& c = classes_[classOf(bytes)];
  const auto offset = reinterpret_cast<uintptr_t>(place) - reinterpret_cast<uintptr_t>(block_.data());
  if (has_block_ && offset < block_.size()) {
    c.in_block = new (place) Free{c.in_block};
    return;
  }
  ::operator delete(place, std::align_val_t{kAlignment});
  ++c.elsewhere;
}

}  // namespace pfx
