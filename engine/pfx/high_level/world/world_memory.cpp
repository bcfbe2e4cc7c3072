// A world in a block of the caller's, or on the heap. The block begins with the book of what is in it.
#include <new>
#include <stdexcept>
#include <string>

#include "pfx/high_level/world/world_impl.h"

namespace pfx {
namespace {

constexpr size_t kBookBytes =
    (sizeof(BlockMemory) + BlockMemory::kAlignment - 1) / BlockMemory::kAlignment * BlockMemory::kAlignment;

BlockMemory* makeMemory(std::span<std::byte> block) {
  if (block.empty()) return new BlockMemory();
  if (block.size() < kBookBytes)
    throw std::length_error("world: a block of " + std::to_string(block.size()) + " bytes is too small");
  return new (block.data()) BlockMemory(block.subspan(kBookBytes));
}

void destroyMemory(BlockMemory* memory) {
  if (!memory->hasBlock()) return delete memory;
  memory->~BlockMemory();
}

}  // namespace

World::World(const WorldDef& def, std::span<std::byte> block) {
  if (def.substeps < 1) throw std::invalid_argument("world: substeps must be >= 1");
  if (!def.gravity.allFinite()) throw std::invalid_argument("world: gravity is not finite");
  BlockMemory* memory = makeMemory(block);
  const MemoryScope scope(memory);
  impl_.reset(new (memory->allocate(sizeof(Impl))) Impl(def));
  requireRoom();
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::Destroy::operator()(Impl* impl) const {
  BlockMemory* memory = impl->memory;
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
