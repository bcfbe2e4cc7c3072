// Joints of a world: handles, what they switch off and wake, and what they report.
#include <gtest/gtest.h>

#include "pfx/high_level/world/body_drag.h"
#include "pfx/high_level/world/world.h"

namespace pfx {
namespace {

constexpr float kDt = 1.0f / 60.0f;

BodyId addBox(World& world, const Vec3& at, MotionType type = MotionType::Active) {
  return world.addBody(
      {.pose = {.position = at}, .motion_type = type, .shapes = {{Box{Vec3::Constant(0.5f)}}}});
}

struct Hanging {
  World world;
  BodyId post = addBox(world, Vec3(0, 5, 0), MotionType::Fixed);
  BodyId box = addBox(world, Vec3(0, 3.5f, 0));
  explicit Hanging(const WorldDef& def = {}) : world(def) {}
  JointId join(const JointParams& params) {
    return world.addJoint({.name = "j", .body_a = post, .body_b = box, .params = params});
  }
};

TEST(WorldJoints, aHandleDiesWithItsJointOrItsBody) {
  Hanging h;
  const JointId first = h.join(BallJointParams{.anchor_point = Vec3(0, 4.25f, 0)});
  EXPECT_TRUE(h.world.isValid(first));
  h.world.removeJoint(first);
  EXPECT_FALSE(h.world.isValid(first));
  const JointId second = h.join(BallJointParams{.anchor_point = Vec3(0, 4.25f, 0)});
  EXPECT_EQ(second.index, first.index);
  EXPECT_FALSE(h.world.isValid(first));
  h.world.removeBody(h.box);
  EXPECT_FALSE(h.world.isValid(second));
  EXPECT_EQ(h.world.counts().joints, 0u);
  h.world.step(kDt);
}

TEST(WorldJoints, rejectsBadInput) {
  Hanging h;
  EXPECT_THROW(h.world.addJoint({.body_a = h.post, .body_b = h.post}), std::invalid_argument);
  EXPECT_THROW(h.world.addJoint({.body_a = h.post, .body_b = {}}), std::invalid_argument);
  EXPECT_THROW(h.join(BallJointParams{.anchor_point = Vec3(0, NAN, 0)}), std::invalid_argument);
  EXPECT_THROW(h.join(BallJointParams{.bias = 1.5f}), std::invalid_argument);
  EXPECT_THROW(h.join(GearJointParams{.ratio = 0.0f}), std::invalid_argument);
  EXPECT_EQ(h.world.counts().joints, 0u);
}

TEST(WorldJoints, carryAWeightAndReportIt) {
  for (const JointSolver solver : {JointSolver::Direct, JointSolver::Soft}) {
    Hanging h({.joint_solver = solver});
    h.join(BallJointParams{.anchor_point = Vec3(0, 4.25f, 0)});
    for (int i = 0; i < 120; ++i) h.world.step(kDt);
    EXPECT_NEAR(h.world.states()[h.box.index].position.y(), 3.5f, 1e-3f);
    EXPECT_NEAR(h.world.joints()[0].force.y(), 9.8f, 1e-2f);  // of one kilogram
    EXPECT_LT(h.world.jointError(0).distance, 1e-3);
  }
}

TEST(WorldJoints, jointedBodiesPassThroughEachOtherUnlessAskedToCollide) {
  for (const bool collide : {false, true}) {
    World world;
    const BodyId a = addBox(world, Vec3(0, 0, 0), MotionType::Fixed), b = addBox(world, Vec3(0, 0.9f, 0));
    world.addJoint({.body_a = a, .body_b = b, .params = BallJointParams{}, .bodies_collide = collide});
    world.step(kDt);
    EXPECT_EQ(world.counts().touching_pairs, collide ? 1u : 0u);
  }
}

TEST(WorldJoints, breakBeyondTheirStrength) {
  Hanging h;
  h.world.addJoint({.body_a = h.post,
                    .body_b = h.box,
                    .params = BallJointParams{.anchor_point = Vec3(0, 4.25f, 0)},
                    .break_force = 20.0f});
  for (int i = 0; i < 30; ++i) h.world.step(kDt);
  EXPECT_TRUE(h.world.brokenJoints().empty());
  h.world.state(h.box).linear_velocity = Vec3(0, -5, 0);
  h.world.step(kDt);
  EXPECT_EQ(h.world.brokenJoints().size(), 1u);
  EXPECT_EQ(h.world.counts().joints, 0u);
}

TEST(WorldJoints, aJointMayChangeItsKind) {
  Hanging h;
  const JointId id = h.join(FixedJointParams{.anchor_point = Vec3(0, 4.25f, 0)});
  for (int i = 0; i < 30; ++i) h.world.step(kDt);
  const auto states = h.world.states();
  h.world.joint(id) =
      makeSliderJoint(states[h.post.index], states[h.box.index], {.direction = Vec3::UnitY()});
  for (int i = 0; i < 30; ++i) h.world.step(kDt);
  EXPECT_NEAR(h.world.states()[h.box.index].position.y(), 3.5f - 0.5f * 9.8f * 0.25f, 1e-2f);
}

TEST(WorldJoints, islandsOfJointedBodiesSleepAndWakeTogether) {
  World world({.sleeping = true, .sleep_steps = 30});
  const BodyId post = addBox(world, Vec3(0, 8, 0), MotionType::Fixed);
  const BodyId upper = addBox(world, Vec3(0, 6.5f, 0)), lower = addBox(world, Vec3(0, 5, 0));
  world.addJoint(
      {.body_a = post, .body_b = upper, .params = BallJointParams{.anchor_point = Vec3(0, 7.25f, 0)}});
  const JointId joint = world.addJoint(
      {.body_a = upper, .body_b = lower, .params = BallJointParams{.anchor_point = Vec3(0, 5.75f, 0)}});
  for (int i = 0; i < 60; ++i) world.step(kDt);
  EXPECT_EQ(world.counts().awake, 0u);
  world.state(upper).linear_velocity = Vec3(1, 0, 0);
  EXPECT_EQ(world.counts().awake, 2u);
  for (int i = 0; i < 5; ++i) world.step(kDt);
  world.removeJoint(joint);
  for (int i = 0; i < 30; ++i) world.step(kDt);
  EXPECT_LT(world.states()[lower.index].position.y(), 4.5f);
}

TEST(WorldJoints, drivesTurnHoldAndSpring) {
  for (const JointSolver solver : {JointSolver::Direct, JointSolver::Soft}) {
    WorldDef def{.gravity = Vec3::Zero()};
    def.joint_solver = solver;
    Hanging h(def);
    const JointId id = h.join(HingeJointParams{.anchor_point = Vec3(0, 3.5f, 0), .axis = Vec3::UnitY()});
    AxisConstraint& axis = h.world.joint(id).axis[3];
    axis.motor_speed = 2.0f;
    axis.motor_max_force = 0.5f;  // N m on 1/6 kg m^2: 3 rad/s^2
    for (int i = 0; i < 30; ++i) h.world.step(kDt);
    EXPECT_NEAR(h.world.states()[h.box.index].angular_velocity.y(), 1.5f, 1e-2f);
    for (int i = 0; i < 30; ++i) h.world.step(kDt);
    EXPECT_NEAR(h.world.states()[h.box.index].angular_velocity.y(), 2.0f, 1e-3f);
  }
}

TEST(WorldJoints, gearsKeepTheirRatio) {
  World world({.gravity = Vec3::Zero()});
  const BodyId post = addBox(world, Vec3(0, 5, 0), MotionType::Fixed);
  const BodyId a = addBox(world, Vec3(-2, 0, 0)), b = addBox(world, Vec3(2, 0, 0));
  const Vec3 z = Vec3::UnitZ();
  for (const auto& [wheel, x] : {std::pair(a, -2.0f), std::pair(b, 2.0f)})
    world.addJoint({.body_a = post,
                    .body_b = wheel,
                    .params = HingeJointParams{.anchor_point = Vec3(x, 0, 0), .axis = z}});
  const JointId gear = world.addJoint(
      {.body_a = a, .body_b = b, .params = GearJointParams{.axis_a = z, .axis_b = z, .ratio = 20.0f}});
  world.state(a).angular_velocity = Vec3(0, 0, 0.5f);
  for (int i = 0; i < 600; ++i) world.step(kDt);
  EXPECT_NEAR(world.states()[b.index].angular_velocity.z() / world.states()[a.index].angular_velocity.z(),
              -20.0f, 0.02f);
  EXPECT_LT(world.jointError(gear.index).angle,
            1e-2);  // after ten turns of B a float holds 1e-5 rad of each angle
}

TEST(WorldJoints, aDraggedBodyFollowsAndLetsGo) {
  World world;
  const BodyId box = addBox(world, Vec3(0, 3, 0));
  BodyDrag drag;
  drag.begin(world, box, Vec3(0, 3.5f, 0));
  for (int i = 0; i < 120; ++i) {
    drag.move(world, Vec3(0.02f * static_cast<float>(i), 3.5f, 0));
    world.step(kDt);
  }
  EXPECT_NEAR(world.states()[box.index].position.x(), 2.4f, 0.5f);
  EXPECT_GT(world.states()[box.index].position.y(), 2.5f);
  drag.end(world);
  EXPECT_FALSE(drag.isHolding(world));
  for (int i = 0; i < 60; ++i) world.step(kDt);
  EXPECT_LT(world.states()[box.index].position.y(), 1.0f);
}

// The same bits for any number of workers and either kernel.
TEST(WorldJoints, resultsDoNotDependOnWorkersOrKernels) {
  const auto run = [](int workers, SimdLevel simd, JointSolver solver) {
    WorldDef def{.workers = workers};
    def.simd = simd;
    def.joint_solver = solver;
    World world(def);
    addBox(world, Vec3(0, -1, 0), MotionType::Fixed);
    BodyId last = addBox(world, Vec3(0, 9, 0), MotionType::Fixed);
    for (int i = 0; i < 20; ++i) {
      const float x = static_cast<float>(i + 1);
      const BodyId next = addBox(world, Vec3(1.2f * x, 9, 0));
      world.addJoint({.body_a = last,
                      .body_b = next,
                      .params = SwingTwistJointParams{.anchor_point = Vec3(1.2f * x - 0.6f, 9, 0)}});
      last = next;
    }
    for (int i = 0; i < 60; ++i) world.step(kDt);
    return world.stateHash();
  };
  for (const JointSolver solver : {JointSolver::Direct, JointSolver::Soft}) {
    const uint64_t expected = run(1, SimdLevel::Sse2, solver);
    EXPECT_EQ(run(1, SimdLevel::Auto, solver), expected);
    EXPECT_EQ(run(3, SimdLevel::Auto, solver), expected);
  }
}

}  // namespace
}  // namespace pfx
