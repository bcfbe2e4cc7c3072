// A world in one block of the caller's: nothing comes from the heap, and the size that it says it needs is exact.
#include <gtest/gtest.h>

#include <cstring>
#include <new>

#include "pfx/high_level/world/world.h"
#include "tests/support/counted_allocations.h"

namespace {

using namespace pfx;

constexpr float kDt = 1.0f / 60.0f;

// As large as it is told, aligned, and watched: nothing may be written around it.
class Block {
 public:
  explicit Block(size_t bytes)
      : bytes_(bytes), data_(static_cast<std::byte*>(::operator new(bytes + 2 * kGuard, std::align_val_t{kGuard}))) {
    std::memset(data_, kMark, bytes_ + 2 * kGuard);
  }
  ~Block() { ::operator delete(data_, std::align_val_t{kGuard}); }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  std::span<std::byte> span() { return {data_ + kGuard, bytes_}; }
  bool guardsAreWhole() const {
    for (size_t i = 0; i < kGuard; ++i)
      if (data_[i] != std::byte{kMark} || data_[kGuard + bytes_ + i] != std::byte{kMark}) return false;
    return true;
  }

 private:
  static constexpr size_t kGuard = BlockMemory::kAlignment;
  static constexpr int kMark = 0x5a;
  size_t bytes_;
  std::byte* data_;
};

// Made once, so that what the caller holds is not counted.
struct Definitions {
  BodyDef ground{.name = "ground",
                 .pose = {.position = Vec3(0.0f, -1.0f, 0.0f)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {Shape{Box{Vec3(50.0f, 1.0f, 50.0f)}, {}}}};
  BodyDef box{.name = "a box whose name is longer than fits", .shapes = {Shape{Box{Vec3::Constant(0.5f)}, {}}}};
  BodyDef dumb_bell{.name = "dumb-bell",
                    .shapes = {Shape{Capsule{0.5f, 0.1f}, {}}, Shape{Sphere{0.3f}, {.position = Vec3(0.5f, 0.0f, 0.0f)}},
                               Shape{Sphere{0.3f}, {.position = Vec3(-0.5f, 0.0f, 0.0f)}}}};
  JointDef hinge{.name = "hinge"};
  WorldDef world{.sleeping = true, .sleep_steps = 30, .report_events = true};
};

// A tower, a pendulum and things that fall on them; a body goes and another comes.
void buildAndRun(World& world, Definitions& d, int steps) {
  const BodyId ground = world.addBody(d.ground);
  for (int i = 0; i < 12; ++i) {
    d.box.pose.position = Vec3(0.0f, 0.5f + static_cast<float>(i), 0.0f);
    world.addBody(d.box);
  }
  for (int i = 0; i < 8; ++i) {
    d.dumb_bell.pose.position = Vec3(3.0f, 1.0f + 0.8f * static_cast<float>(i), 0.3f * static_cast<float>(i % 3));
    world.addBody(d.dumb_bell);
  }
  d.box.pose.position = Vec3(-4.0f, 5.0f, 0.0f);
  const BodyId bob = world.addBody(d.box);
  d.hinge.body_a = ground, d.hinge.body_b = bob;
  d.hinge.params = HingeJointParams{.anchor_point = Vec3(-6.0f, 5.0f, 0.0f), .axis = Vec3::UnitZ()};
  world.addJoint(d.hinge);
  for (int i = 0; i < steps; ++i) {
    if (i == 40) world.removeBody(bob);
    if (i == 45) world.addBody(d.box);
    world.step(kDt);
  }
}

constexpr int kSteps = 200;

struct Needed {
  size_t bytes;
  uint64_t hash;
};

Needed trialRun() {
  Definitions d;
  World world(d.world);
  buildAndRun(world, d, kSteps);
  return {world.memoryBytes(), world.stateHash()};
}

TEST(WorldMemory, AWorldLivesInItsBlockFromTheFirstBodyToTheLastStep) {
  const Needed needed = trialRun();
  RecordProperty("block_bytes", std::to_string(needed.bytes));
  Block block(needed.bytes);
  Definitions d;
  const long before = support::g_allocations.load();
  World world(d.world, block.span());
  buildAndRun(world, d, kSteps);
  EXPECT_EQ(support::g_allocations.load() - before, 0);
  EXPECT_EQ(world.stateHash(), needed.hash);
  EXPECT_EQ(world.memoryBytes(), needed.bytes);
  EXPECT_TRUE(block.guardsAreWhole());
}

TEST(WorldMemory, OneUnitLessIsRefusedWithWhatIsNeededAndTheWorldGoesOnAllTheSame) {
  const Needed needed = trialRun();
  Block block(needed.bytes - BlockMemory::kAlignment);
  Definitions d;
  World world(d.world, block.span());
  std::string message;
  try {
    buildAndRun(world, d, kSteps);
  } catch (const std::length_error& e) {
    message = e.what();
  }
  EXPECT_NE(message.find("is too small"), std::string::npos) << message;
  EXPECT_NE(message.find(std::to_string(needed.bytes)), std::string::npos) << message;
  EXPECT_TRUE(block.guardsAreWhole());
  // The step was done; and whoever catches the error may go on.
  const uint64_t steps = world.stepCount();
  EXPECT_THROW(world.step(kDt), std::length_error);
  EXPECT_EQ(world.stepCount(), steps + 1);
}

TEST(WorldMemory, ABlockThatHoldsNoWorldOrIsNotAlignedIsRefused) {
  const size_t empty = World().memoryBytes();
  Block block(empty);
  EXPECT_NO_THROW(World({}, block.span()));
  EXPECT_THROW(World({}, block.span().first(empty - BlockMemory::kAlignment)), std::length_error);
  EXPECT_THROW(World({}, block.span().first(1)), std::length_error);
  EXPECT_THROW(World({}, block.span().subspan(8)), std::invalid_argument);
  EXPECT_THROW(World({}, Block(2 * empty).span().subspan(1)), std::invalid_argument);
}

TEST(WorldMemory, ASnapshotIsRestoredWithinTheBlock) {
  Definitions d;
  World heap(d.world);
  buildAndRun(heap, d, 100);
  std::vector<std::byte> bytes(heap.snapshotBytes());
  heap.snapshot(bytes);
  for (int i = 0; i < 100; ++i) heap.step(kDt);

  Block block(size_t(16) << 20);
  World world({}, block.span());
  world.restore(bytes);
  for (int i = 0; i < 100; ++i) world.step(kDt);
  EXPECT_EQ(world.stateHash(), heap.stateHash());
  EXPECT_TRUE(block.guardsAreWhole());
}

TEST(WorldMemory, AMovedWorldTakesItsBlockAlong) {
  Block block(size_t(4) << 20);
  Definitions d;
  World first(d.world, block.span());
  first.addBody(d.ground);
  World second = std::move(first);
  second.addBody(d.box);
  second.step(kDt);
  EXPECT_EQ(second.counts().bodies, 2u);
  second = World();
  EXPECT_TRUE(block.guardsAreWhole());
}

TEST(BlockMemory, UsesFreedPlacesAgainForTheirSizeOnly) {
  Block block(1024);
  BlockMemory memory(block.span());
  void* a = memory.allocate(100);
  void* b = memory.allocate(100);
  EXPECT_NE(a, b);
  memory.deallocate(a, 100);
  EXPECT_EQ(memory.allocate(128), a);  // of the same class
  EXPECT_EQ(memory.needed(), 256u);
  memory.deallocate(b, 100);
  EXPECT_NE(memory.allocate(200), b);
  EXPECT_EQ(memory.needed(), 256u + 256u);
  EXPECT_EQ(memory.missing(), 0u);
  void* outside = memory.allocate(1000);
  EXPECT_EQ(memory.missing(), 512u);
  memory.deallocate(outside, 1000);
}

}  // namespace
