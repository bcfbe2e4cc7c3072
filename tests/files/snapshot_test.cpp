// Snapshots: a world that goes back, or another one that takes over, continues to the bit.
#include "pfx/high_level/world/snapshot.h"

#include <gtest/gtest.h>

#include "pfx/base_level/shape/convex_mesh.h"
#include "tests/files/scene_run.h"

namespace {

using namespace pfx;
using samples::RunningScene;
using samples::SceneEntry;

std::vector<std::byte> take(const World& world) {
  std::vector<std::byte> bytes(world.snapshotBytes());
  EXPECT_EQ(world.snapshot(bytes), bytes.size());
  return bytes;
}

class SampleSnapshot : public testing::TestWithParam<SceneEntry> {};

TEST_P(SampleSnapshot, ContinuesInAnotherWorldLikeTheUninterruptedRun) {
  RunningScene original(GetParam()), script(GetParam());
  constexpr int kBefore = 45, kAfter = 60;
  World other;
  for (int i = 0; i < kBefore; ++i) {
    original.step();
    script.step();
  }
  other.restore(take(original.world));
  EXPECT_EQ(take(other), take(original.world));
  for (int i = 0; i < kAfter; ++i) {
    original.step();
    script.stepIn(other);
    ASSERT_EQ(other.stateHash(), original.world.stateHash()) << "step " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SampleSnapshot, testing::ValuesIn(samples::scenes().begin(), samples::scenes().end()),
                         [](const auto& scene) { return samples::testName(scene.param); });

// Boxes that fall asleep in two heaps, joined at the top, and a body that comes and wakes them.
struct Heap {
  explicit Heap(World& world) {
    world.addBody({.motion_type = MotionType::Fixed, .shapes = {Shape{Box{Vec3(20.0f, 1.0f, 20.0f)}, {}}}});
    BodyId last[2];
    for (int heap = 0; heap < 2; ++heap)
      for (int i = 0; i < 4; ++i)
        last[heap] = world.addBody({.pose = {.position = Vec3(2.0f * static_cast<float>(heap), 1.5f + static_cast<float>(i), 0.0f)},
                                    .shapes = {Shape{Box{Vec3::Constant(0.5f)}, {}}}});
    const BodyId chain = world.addBody({.pose = {.position = Vec3(1.0f, 6.0f, 3.0f)}, .shapes = {Shape{Sphere{0.2f}, {}}}});
    world.addJoint({.body_a = last[0], .body_b = chain, .params = BallJointParams{.anchor_point = Vec3(0.0f, 5.0f, 0.0f)}});
    hammer = world.addBody({.pose = {.position = Vec3(-30.0f, 2.0f, 0.0f)},
                            .linear_velocity = Vec3(6.0f, 0.0f, 0.0f),
                            .shapes = {Shape{Sphere{0.5f}, {}}},
                            .gravity_scale = 0.0f});
  }
  BodyId hammer;
};

TEST(Snapshot, KeepsSleepersSoThatTheyWakeTheSameWay) {
  World world({.sleeping = true, .sleep_steps = 30});
  Heap heap(world);
  while (world.stepCount() < 270) world.step(1.0f / 60.0f);  // the hammer is 1.5 m away
  const uint32_t awake = world.counts().awake;
  ASSERT_LT(awake, 9u) << "something must sleep, or the test proves nothing";
  World other({.workers = 2});
  other.restore(take(world));
  bool woke = false;
  for (int i = 0; i < 300; ++i) {
    world.step(1.0f / 60.0f);
    other.step(1.0f / 60.0f);
    woke = woke || world.counts().awake > awake;
    ASSERT_EQ(other.stateHash(), world.stateHash()) << "step " << i;
  }
  EXPECT_TRUE(woke) << "the hammer must wake a heap, or the test proves nothing";
}

TEST(Snapshot, TakesTheSameWorldBackAndItsHandlesStayValid) {
  World world({.sleeping = true, .sleep_steps = 30});
  Heap heap(world);
  while (world.stepCount() < 150) world.step(1.0f / 60.0f);
  const std::vector<std::byte> bytes = take(world);
  std::vector<uint64_t> first, second;
  for (auto* hashes : {&first, &second}) {
    world.restore(bytes);
    ASSERT_TRUE(world.isValid(heap.hammer));
    for (int i = 0; i < 150; ++i) world.step(1.0f / 60.0f), hashes->push_back(world.stateHash());
    world.removeBody(heap.hammer);
    world.step(1.0f / 60.0f);
  }
  EXPECT_EQ(first, second);
}

TEST(Snapshot, RemembersRemovedBodiesAndTheirPlaces) {
  World world;
  Heap heap(world);
  world.step(1.0f / 60.0f);
  world.removeBody(heap.hammer);
  World other;
  other.restore(take(world));
  const BodyDef def{.shapes = {Shape{Sphere{0.5f}, {}}}};
  EXPECT_EQ(other.addBody(def), world.addBody(def));
  EXPECT_FALSE(other.isValid(heap.hammer));
}

TEST(Snapshot, ATooShortBufferIsRefused) {
  World world;
  Heap heap(world);
  std::vector<std::byte> bytes(world.snapshotBytes() - 1);
  EXPECT_THROW(world.snapshot(bytes), SnapshotError);
}

TEST(Snapshot, OfAMeshOfTheCallersIsRefusedByTheNameOfItsBody) {
  const ConvexMesh mesh = [] {
    World world;
    samples::RunningScene scene(*samples::findScenes("1_simple/primitives").front());
    for (const Collidable& c : scene.world.collidables())
      if (const auto* m = std::get_if<const ConvexMesh*>(&c.shapes()[0].geometry)) return **m;
    return ConvexMesh{};
  }();
  World world;
  world.addBody({.name = "loan", .shapes = {Shape{&mesh, {}}}});
  std::vector<std::byte> bytes(1 << 20);
  try {
    world.snapshot(bytes);
    FAIL();
  } catch (const SnapshotError& e) {
    EXPECT_STREQ(e.what(), "snapshot: body \"loan\" has a mesh that the world does not keep");
  }
}

TEST(Snapshot, ADamagedSectionIsNamedWithItsPlace) {
  World world;
  Heap heap(world);
  std::vector<std::byte> bytes = take(world);
  bytes[bytes.size() / 2] ^= std::byte{4};
  const uint64_t before = world.stateHash();
  try {
    world.restore(bytes);
    FAIL();
  } catch (const SnapshotError& e) {
    EXPECT_TRUE(std::string(e.what()).starts_with("snapshot: bodies (bytes ")) << e.what();
    EXPECT_TRUE(std::string(e.what()).ends_with("): is damaged")) << e.what();
  }
  EXPECT_EQ(world.stateHash(), before);
}

TEST(Snapshot, HasTheSameBytesOnEveryPlatform) {
  World world;
  world.addBody({.name = "ball", .pose = {.position = Vec3(1.0f, 0.0f, 0.0f)}, .shapes = {Shape{Sphere{0.5f}, {}}}});
  const std::vector<std::byte> bytes = take(world);
  const auto at = [&](size_t i) { return std::to_integer<int>(bytes[i]); };
  EXPECT_EQ(at(0), 'P');
  EXPECT_EQ(at(8), 4) << "version, least byte first";
  EXPECT_EQ(at(11), 0);
  EXPECT_EQ(at(12), 6) << "sections";
  EXPECT_EQ(at(16), 'W');
}

}  // namespace
