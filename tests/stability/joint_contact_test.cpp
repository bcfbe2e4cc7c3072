// Joints and contacts that carry one load: heavy goods on a tray that hangs on chains, a wrecking ball. 60
// Hz, 4 sub-steps.
#include <gtest/gtest.h>

#include "tests/stability/hard_scenes.h"
#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

constexpr float kLink = 0.2f;  // m

// Links of capsules that hang down (or along `way`) from a body at a point; returns the last one.
struct ChainDef {
  Vec3 from = Vec3::Zero(), way = -Vec3::UnitY();
  int links = 5;
  float mass = 0.05f;  // kg, of a link
};
BodyId addChain(World& world, BodyId last, const ChainDef& d) {
  const Quat turn = Quat::FromTwoVectors(Vec3::UnitX(), d.way).normalized();
  for (int i = 0; i < d.links; ++i) {
    const Vec3 top = d.from + kLink * static_cast<float>(i) * d.way;
    const BodyId link = world.addBody({.name = "link",
                                       .pose = {top + 0.5f * kLink * d.way, turn},
                                       .shapes = {{Capsule{0.4f * kLink, 0.02f}}},
                                       .mass = d.mass,
                                       .filter_self = 0});
    world.addJoint({.body_a = last, .body_b = link, .params = BallJointParams{.anchor_point = top}});
    last = link;
  }
  return last;
}

struct TrayResult {
  double gap = 0.0, overlap = 0.0, speed = 0.0, fall = 0.0;
  double force = 0.0;  // N, of the joints at the top
};

// A tray of 1 kg on four chains, with a crate on it.
TrayResult runTray(float crate_mass) {
  World world(hardDef());
  const BodyId ceiling = addPost(world, Vec3(0, 2, 0));
  const BodyId tray =
      addBox(world, {.half_extent = Vec3(0.6f, 0.05f, 0.6f), .position = Vec3(0, 0, 0), .mass = 1.0f});
  const BodyId crate =
      addBox(world, {.half_extent = Vec3::Constant(0.3f), .position = Vec3(0, 0.35f, 0), .mass = crate_mass});
  std::vector<JointId> tops;
  for (const float x : {-0.5f, 0.5f})
    for (const float z : {-0.5f, 0.5f}) {
      const Vec3 hook(x, 1, z), eye(x, 0, z);
      tops.push_back({static_cast<uint32_t>(world.joints().size()), 1});
      const BodyId last = addChain(world, ceiling, {.from = hook});
      world.addJoint({.body_a = last, .body_b = tray, .params = BallJointParams{.anchor_point = eye}});
    }
  TrayResult r;
  for (int i = 0; i < 600; ++i) {
    world.step(kStep);
    r.gap = std::max(r.gap, largestGap(world));
    if (i < 300) continue;
    r.overlap = std::max(r.overlap, deepest(world));
    for (const RigidState& s : world.states())
      if (isDynamic(s.motion_type))
        r.speed = std::max(r.speed, static_cast<double>(s.linear_velocity.norm()));
  }
  r.fall = 0.35 - static_cast<double>(world.states()[crate.index].position.y());
  for (const JointId top : tops) r.force += static_cast<double>(world.joints()[top.index].force.y());
  return r;
}

TEST(JointsAndContacts, ATrayOnChainsCarriesACrate) {
  for (const float mass : {50.0f, 1000.0f}) {
    const TrayResult r = runTray(mass);
    std::printf("  crate of %.0f kg, links of 0.05 kg\n", static_cast<double>(mass));
    report("tray, 10 s: gap", r.gap, 1e-3, "m");
    report("tray: overlap of crate and tray", r.overlap, 2e-3, "m");
    report("tray: speed after 5 s", r.speed, 1e-2, "m/s");
    report("tray: crate sinks by", r.fall, 5e-3, "m");
    report("tray: pull of the chains, relative", r.force / (kGravity * (double(mass) + 2.0)) - 1.0, 1e-2, "");
    EXPECT_LT(r.gap, 1e-3);
    EXPECT_LT(r.overlap, 2e-3);
    EXPECT_LT(r.speed, 1e-2);
    EXPECT_LT(std::abs(r.fall), 5e-3);
  }
}

// A ball of 100 kg on links of 0.1 kg swings into a wall of boxes of 1 kg.
TEST(JointsAndContacts, AWreckingBallStaysOnItsChain) {
  World world(hardDef());
  addFloor(world);
  const Vec3 hook(0, 2.6f, 0);
  const BodyId post = addPost(world, hook);
  const BodyId last = addChain(world, post, {.from = hook, .way = Vec3(-1, 0, 0), .links = 10, .mass = 0.1f});
  const Vec3 at = hook + Vec3(-10.0f * kLink - 0.3f, 0, 0);
  const BodyId ball = world.addBody({.pose = {.position = at},
                                     .shapes = {{Sphere{0.25f}}},
                                     .mass = 100.0f,
                                     .restitution = 0.0f,
                                     .friction = 0.6f});
  world.addJoint(
      {.body_a = last, .body_b = ball, .params = BallJointParams{.anchor_point = at + Vec3(0.3f, 0, 0)}});
  for (int row = 0; row < 5; ++row)
    for (int i = -2; i <= 2; ++i)
      addBox(world,
             {.half_extent = Vec3::Constant(0.2f),
              .position = Vec3(0.5f, 0.2f + 0.4f * static_cast<float>(row), 0.4f * static_cast<float>(i))});
  const double e0 = energy(world), scale = 100.0 * kGravity * 2.3;
  double gap = 0.0, gained = 0.0, speed = 0.0;
  for (int i = 0; i < 600; ++i) {
    world.step(kStep);
    gap = std::max(gap, largestGap(world));
    gained = std::max(gained, (energy(world) - e0) / scale);
    for (const RigidState& s : world.states())
      speed = std::max(speed, static_cast<double>(s.linear_velocity.norm()));
  }
  report("wrecking ball, 1:1000, 10 s: gap", gap, 5e-3, "m");
  report("wrecking ball: energy gained", gained, 1e-3, "");
  report("wrecking ball: fastest, the ball reaches 6.7", speed, 34.0, "m/s");
  EXPECT_LT(gap, 5e-3);
  EXPECT_LT(gained, 1e-3);
  EXPECT_LT(speed, 34.0);
}

}  // namespace
}  // namespace pfx_test
