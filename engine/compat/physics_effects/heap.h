// A stack of blocks in memory of the application, for the buffers of the stages.
#pragma once

#include "base.h"

namespace sce {
namespace PhysicsEffects {

// What was allocated last is given back first. Takes nothing but the memory that it was given, which must outlive it.
class PfxHeapManager {
 public:
  enum { ALIGN16 = 16, ALIGN128 = 128 };

  // An empty stack in so many bytes.
  PfxHeapManager(unsigned char* buffer, PfxUInt32 bytes) : begin_(buffer), end_(buffer + bytes), top_(buffer) {}
  PfxHeapManager(const PfxHeapManager&) = delete;
  PfxHeapManager& operator=(const PfxHeapManager&) = delete;

  // Aligned to a power of two of at least 16. NULL, and nothing is taken, when the rest is too small.
  void* allocate(size_t bytes, int alignment = ALIGN16) {
    const PfxUIntPtr at = alignUp(reinterpret_cast<PfxUIntPtr>(top_) + sizeof(unsigned char*), static_cast<PfxUIntPtr>(alignment));
    if (bytes > reinterpret_cast<PfxUIntPtr>(end_) || at > reinterpret_cast<PfxUIntPtr>(end_) - bytes) return nullptr;
    unsigned char* const block = top_ + (at - reinterpret_cast<PfxUIntPtr>(top_));
    ::std::memcpy(block - sizeof top_, &top_, sizeof top_);  // where the block below ended
    top_ = block + bytes;
    return block;
  }
  // The block that was allocated last of those that are left; NULL does nothing.
  void deallocate(void* block) {
    if (block != nullptr) ::std::memcpy(&top_, static_cast<unsigned char*>(block) - sizeof top_, sizeof top_);
  }
  // Gives everything back.
  void clear() { top_ = begin_; }
  // Bytes, with what blocks take besides their own.
  int getAllocated() const { return static_cast<int>(top_ - begin_); }
  int getRest() const { return static_cast<int>(end_ - top_); }

 private:
  static PfxUIntPtr alignUp(PfxUIntPtr at, PfxUIntPtr alignment) { return (at + alignment - 1) / alignment * alignment; }

  unsigned char *begin_, *end_, *top_;
};

}  // namespace PhysicsEffects
}  // namespace sce
