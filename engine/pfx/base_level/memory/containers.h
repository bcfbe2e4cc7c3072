// Containers of the standard library in the memory of their world (block_memory.h).
#pragma once

#include <deque>
#include <functional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "pfx/base_level/memory/block_memory.h"

namespace pfx {

// A copy of a container lives where its thread says, not where the original does; what is moved or swapped stays.
template <class T>
class BlockAllocator {
 public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  BlockAllocator() : memory_(currentMemory()) {}
  template <class U>
  BlockAllocator(const BlockAllocator<U>& other) : memory_(other.memory()) {}  // NOLINT: converts, as allocators must

  T* allocate(size_t count) {
    static_assert(alignof(T) <= BlockMemory::kAlignment);
    if (memory_ == nullptr) return std::allocator<T>().allocate(count);
    if (count > static_cast<size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(memory_->allocate(count * sizeof(T)));
  }
  void deallocate(T* place, size_t count) noexcept {
    if (memory_ == nullptr) return std::allocator<T>().deallocate(place, count);
    memory_->deallocate(place, count * sizeof(T));
  }

  BlockAllocator select_on_container_copy_construction() const { return {}; }
  BlockMemory* memory() const { return memory_; }
  template <class U>
  bool operator==(const BlockAllocator<U>& other) const {
    return memory_ == other.memory();
  }

 private:
  BlockMemory* memory_;
};

template <class T>
using Vector = std::vector<T, BlockAllocator<T>>;
template <class T>
using Deque = std::deque<T, BlockAllocator<T>>;
template <class T>
using Set = std::set<T, std::less<T>, BlockAllocator<T>>;
using String = std::basic_string<char, std::char_traits<char>, BlockAllocator<char>>;

}  // namespace pfx
