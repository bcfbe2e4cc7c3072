// Memory of a world: one block that the caller supplies, or the heap.
//
// Sizes are rounded up to classes, four to a doubling; what is freed is used again for its class. On the heap the same
// book is kept, so that a world there tells how large a block it would have needed, to the byte. Containers of
// containers.h take the memory that a MemoryScope of their thread names when they are made.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace pfx {

// Keeps threads apart where several share a memory; this floor knows none of its own.
class MemoryLock {
 public:
  virtual void lock() = 0;
  virtual void unlock() = 0;

 protected:
  ~MemoryLock() = default;
};

class BlockMemory {
 public:
  static constexpr size_t kAlignment = 64;  // bytes, of the block and of everything in it

  explicit BlockMemory(MemoryLock* lock = nullptr) : lock_(lock) {}  // the heap
  // Throws std::invalid_argument for a block that is not aligned.
  explicit BlockMemory(std::span<std::byte> block, MemoryLock* lock = nullptr);
  static void requireAligned(std::span<const std::byte> block);  // throws likewise
  BlockMemory(const BlockMemory&) = delete;
  BlockMemory& operator=(const BlockMemory&) = delete;

  // Safe from any thread if there is a lock. What the block has no room for comes from the heap, and is missing(). Throws std::bad_alloc
  // where that is full as well.
  void* allocate(size_t bytes);
  void deallocate(void* place, size_t bytes) noexcept;

  bool hasBlock() const { return has_block_; }
  size_t needed() const { return top_; }  // bytes, of a block that holds all there was so far
  size_t missing() const { return has_block_ && top_ > block_.size() ? top_ - block_.size() : 0; }

 private:
  struct Free {
    Free* next;
  };
  struct SizeClass {
    Free* in_block = nullptr;
    size_t elsewhere = 0;  // number of freed ones that went back to the heap
  };
  static constexpr size_t kClasses = 192;

  static size_t classOf(size_t bytes);
  static size_t sizeOf(size_t size_class);

  std::span<std::byte> block_;
  bool has_block_ = false;
  size_t top_ = 0;  // bytes, of the block that were ever in use, and beyond its end what would have been
  std::array<SizeClass, kClasses> classes_;
  MemoryLock* lock_;
};

// What containers that are made by this thread take their memory from; null: the heap.
BlockMemory* currentMemory();

// Names the memory for as long as it lives.
class MemoryScope {
 public:
  explicit MemoryScope(BlockMemory* memory);
  ~MemoryScope();
  MemoryScope(const MemoryScope&) = delete;
  MemoryScope& operator=(const MemoryScope&) = delete;

 private:
  BlockMemory* before_;
};

}  // namespace pfx
