// Bodies that follow a clip stand where the clip says, and others react to them.
#include "pfx/high_level/world/animation.h"

#include <gtest/gtest.h>

#include "pfx/base_level/math/trig.h"

namespace {

using namespace pfx;

constexpr float kStep = 1.0f / 60.0f;

// An arm that swings by 2 rad in a circle of 2 m and turns with it, 12 keys a second for two seconds; at rest at both ends.
AnimationClip swing() {
  AnimationClip clip;
  for (int i = 0; i <= 24; ++i) {
    const float t = static_cast<float>(i) / 12.0f, angle = 0.5f * t * t * (3.0f - t);
    clip.keys.push_back({t, {Vec3(2.0f * cos(angle), 1.0f, 2.0f * sin(angle)),
                             Quat(cos(0.5f * angle), 0.0f, -sin(0.5f * angle), 0.0f)}});
  }
  return clip;
}

TEST(Animation, ASampleAtAKeyIsTheKeyAndBetweenThemItRunsSmoothly) {
  const AnimationClip clip = swing();
  for (const AnimationKey& k : clip.keys) EXPECT_LT((sample(clip, k.time).position - k.pose.position).norm(), 1e-6f);
  // Tangents of parabolas are off by h^2 |x'''| / 6, with |x'''| below 25 m/s^3 here, and the curve by a quarter of that times h:
  // 0.6 mm.
  for (int i = 0; i < 200; ++i)
    EXPECT_NEAR(Vec3(sample(clip, 0.01f * static_cast<float>(i)).position - Vec3(0.0f, 1.0f, 0.0f)).norm(), 2.0f, 1e-3f);
  EXPECT_EQ(sample(clip, -1.0f).position, clip.keys.front().pose.position);
  EXPECT_EQ(sample(clip, 9.0f).position, clip.keys.back().pose.position);
}

TEST(Animation, ALoopComesBackToItsBeginning) {
  AnimationClip clip = swing();
  clip.loops = true;
  EXPECT_LT((sample(clip, 2.5f).position - sample(clip, 0.5f).position).norm(), 1e-5f);
}

TEST(Animation, ABodyFollowsItsClipToAMillimetreWhilePushingOthersAway) {
  const AnimationClip clip = swing();
  World world;
  world.addBody({.pose = {.position = Vec3(0.0f, -0.5f, 0.0f)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {Shape{Box{Vec3(10.0f, 0.5f, 10.0f)}, {}}}});
  const BodyId arm = world.addBody({.pose = clip.keys.front().pose,
                                    .motion_type = MotionType::Keyframe,
                                    .shapes = {Shape{Box{Vec3(1.0f, 0.3f, 0.2f)}, {}}}});
  std::vector<BodyId> boxes;
  std::vector<Vec3> start;
  for (int i = 0; i < 4; ++i) {
    const float angle = 0.7f + 0.35f * static_cast<float>(i);
    boxes.push_back(world.addBody({.pose = {.position = Vec3(2.0f * cos(angle), 1.0f, 2.0f * sin(angle))},
                                   .shapes = {Shape{Box{Vec3(0.2f, 1.0f, 0.2f)}, {}}},
                                   .mass = 100.0f}));
    start.push_back(world.states()[boxes.back().index].position);
  }
  AnimationPlayer player;
  player.add(arm, clip);
  for (int i = 0; i < 120; ++i) {
    player.advance(world, kStep);
    world.step(kStep);
    const Transform wanted = sample(clip, player.time());
    const RigidState& s = world.states()[arm.index];
    ASSERT_LT((s.position - wanted.position).norm(), 1e-3f) << i;
    ASSERT_GT(std::abs(s.orientation.dot(wanted.orientation)), 1.0f - 1e-6f) << i;
  }
  for (size_t i = 0; i < boxes.size(); ++i)
    EXPECT_GT((world.states()[boxes[i].index].position - start[i]).norm(), 0.2f) << "box " << i;
}

TEST(Animation, ABadClipIsRefusedByItsKey) {
  World world;
  AnimationPlayer player;
  EXPECT_THROW(player.add({0, 1}, AnimationClip{}), std::invalid_argument);
  AnimationClip clip = swing();
  clip.keys[5].time = clip.keys[4].time;
  try {
    player.add({0, 1}, clip);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "animation: key 5: the times do not ascend");
  }
}

}  // namespace
