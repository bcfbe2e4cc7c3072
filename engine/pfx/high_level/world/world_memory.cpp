// A world in a block of the caller's, or on the heap. The block begins with the book of what is in it.
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>

#include "pfx/high_level/world/world_impl.h"

namespace pfx {
namespace {

// Shared by the workers, whose scratch buffers grow.
class WorldMemory final : public BlockMemory, private MemoryLock {
 public:
  WorldMemory() : BlockMemory(this) {}
  explicit WorldMemory(std::span<std::byte> block) : BlockMemory(block, this) {}

 private:
  void lock() override { mutex_.lock(); }
  void unlock() override { mutex_.unlock(); }
  std::mutex mutex_;
};

constexpr size_t kBookBytes =
    (sizeof(WorldMemory) + BlockMemory::kAlignment - 1) / BlockMemory::kAlignment * BlockMemory::kAlignment;

WorldMemory* makeMemory(std::span<std::byte> block) {
  if (block.empty()) return new WorldMemory();
  if (block.size() < kBookBytes)
    throw std::length_error("world: a block of " + std::to_string(block.size()) + " bytes is too small");
  BlockMemory::requireAligned(block);
  return new (block.data()) WorldMemory(block.subspan(kBookBytes));
}

void destroyMemory(WorldMemory* memory) {
  if (!memory->hasBlock()) return delete memory;
  memory->~WorldMemory();
}

}  // namespace

World::World(const WorldDef& def, std::span<std::byte> block) {
  if (def.substeps < 1) throw std::invalid_argument("world: substeps must be >= 1");
  if (!def.gravity.allFinite()) throw std::invalid_argument("world: gravity is not finite");
  std::unique_ptr<WorldMemory, void (*)(WorldMemory*)> memory(makeMemory(block), destroyMemory);
  const MemoryScope scope(memory.get());
  void* place = memory->allocate(sizeof(Impl));
  try {
    impl_.reset(new (place) Impl(def));
  } catch (...) {
    memory->deallocate(place, sizeof(Impl));
    throw;
  }
  memory.release();  // it is the world's, which gives it back
  requireRoom();
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::Destroy::operator()(Impl* impl) const {
  auto* memory = static_cast<WorldMemory*>(impl->memory);
  impl->~Impl();
  memory->deallocate(impl, sizeof(Impl));
  destroyMemory(memory);
}

size_t World::memoryBytes() const { return kBookBytes + impl_->memory->needed(); }

void World::requireRoom() const {
  const size_t missing = impl_->memory->missing();
  if (missing == 0) return;
  throw std::length_error("world: its block of " + std::to_string(memoryBytes() - missing) + " bytes is too small, " +
                          std::to_string(memoryBytes()) + " are needed so far");
}

}  // namespace pfx
