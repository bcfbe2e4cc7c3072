// Joints in the island solver: what they hold, beside contacts and alone.
#include <gtest/gtest.h>

#include "pfx/high_level/world/world.h"

namespace {

using namespace pfx;

constexpr float kStep = 1.0f / 60.0f;

// Everything goes through the island solver.
WorldDef newtonDef() {
  WorldDef def;
  def.contact_solver = ContactSolver::Newton;
  return def;
}

BodyId addFloor(World& world) {
  return world.addBody({.pose = {.position = Vec3(0, -1, 0)},
                        .motion_type = MotionType::Fixed,
                        .shapes = {{Box{Vec3(50, 1, 50)}}},
                        .restitution = 0.0f,
                        .friction = 0.0f});
}

BodyId addBox(World& world, float x, float mass = 2.0f) {
  return world.addBody({.pose = {.position = Vec3(x, 0.5f, 0)},
                        .shapes = {{Box{Vec3::Constant(0.5f)}}},
                        .mass = mass,
                        .restitution = 0.0f,
                        .friction = 0.0f});
}

// Two boxes lie on ice and hang together by a slider along x.
struct SlidingPair {
  World world{newtonDef()};
  BodyId left, right;
  JointId slider;
  SlidingPair() {
    addFloor(world);
    left = addBox(world, -1.0f), right = addBox(world, 1.0f);
    slider = world.addJoint(
        {.body_a = left,
         .body_b = right,
         .params = SliderJointParams{.anchor_point = Vec3(0, 0.5f, 0), .direction = Vec3::UnitX()}});
  }
  AxisConstraint& axis() { return world.joint(slider).axis[0]; }
  float way() const {
    return world.states()[right.index].position.x() - world.states()[left.index].position.x() - 2.0f;
  }
  float speed() const {
    return world.states()[right.index].linear_velocity.x() - world.states()[left.index].linear_velocity.x();
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) world.step(kStep);
  }
};

// The reduced mass is 1 kg: a motor of 3 N makes 3 m/s in a second.
TEST(NewtonJoint, AMotorAcceleratesUpToItsStrengthAndSpeed) {
  SlidingPair pair;
  pair.axis().motor_speed = 4.0f, pair.axis().motor_max_force = 3.0f;
  pair.run(60);
  EXPECT_NEAR(pair.speed(), 3.0f, 3e-3f);
  pair.run(60);
  EXPECT_NEAR(pair.speed(), 4.0f, 4e-3f);
}

TEST(NewtonJoint, ALimitStopsAndReportsWhatItHolds) {
  SlidingPair pair;
  pair.axis().lock = JointLock::Limit, pair.axis().lower = -0.1f, pair.axis().upper = 0.2f;
  pair.world.state(pair.right).linear_velocity = Vec3(2, 0, 0);
  pair.run(60);
  EXPECT_NEAR(pair.way(), 0.2f, 1e-4f);
  EXPECT_NEAR(pair.speed(), 0.0f, 1e-4f);
  EXPECT_NEAR(pair.world.states()[pair.left.index].linear_velocity.x(), 1.0f, 1e-3f) << "they go on together";
}

// 1 Hz on the reduced mass, without damping: back at the start after a second, on the other side after half
// of it.
TEST(NewtonJoint, ASpringSwings) {
  SlidingPair pair;
  pair.axis().spring_frequency = 1.0f, pair.axis().spring_target = 0.1f;
  pair.run(30);
  EXPECT_NEAR(pair.way(), 0.2f, 0.01f);
}

// A box of 500 kg stands on one of 1 kg that hangs from a post: the joint carries both.
TEST(NewtonJoint, AFixedJointReportsTheLoadOfItsContacts) {
  World world(newtonDef());
  const BodyId post = world.addBody(
      {.pose = {.position = Vec3(0, 5, 0)}, .motion_type = MotionType::Fixed, .shapes = {{Sphere{0.1f}}}});
  const BodyId shelf = world.addBody({.pose = {.position = Vec3(0, 0, 0)},
                                      .shapes = {{Box{Vec3(1, 0.1f, 1)}}},
                                      .mass = 1.0f,
                                      .restitution = 0.0f});
  world.addBody({.pose = {.position = Vec3(0, 0.6f, 0)},
                 .shapes = {{Box{Vec3::Constant(0.5f)}}},
                 .mass = 500.0f,
                 .restitution = 0.0f});
  const JointId joint = world.addJoint(
      {.body_a = post, .body_b = shelf, .params = FixedJointParams{.anchor_point = Vec3::Zero()}});
  for (int i = 0; i < 60; ++i) world.step(kStep);
  EXPECT_NEAR(world.joints()[joint.index].force.y(), 501.0f * 9.8f, 0.5f);
  EXPECT_NEAR(world.states()[shelf.index].position.y(), 0.0f, 1e-5f);
}

// A chain of boxes on the ground for any number of workers.
TEST(NewtonJoint, TheStateIsTheSameForAnyNumberOfWorkers) {
  const auto hashWith = [](int workers) {
    WorldDef def = newtonDef();
    def.workers = workers;
    World world(def);
    addFloor(world);
    for (int chain = 0; chain < 4; ++chain) {
      BodyId last;
      for (int i = 0; i < 5; ++i) {
        const Vec3 at(3.0f * static_cast<float>(chain), 0.5f + 1.1f * static_cast<float>(i), 0);
        const BodyId box = world.addBody({.pose = {.position = at}, .shapes = {{Box{Vec3::Constant(0.5f)}}}});
        if (i > 0)
          world.addJoint({.body_a = last,
                          .body_b = box,
                          .params = BallJointParams{.anchor_point = at - Vec3(0.5f, 0.55f, 0)}});
        last = box;
      }
    }
    for (int i = 0; i < 90; ++i) world.step(kStep);
    return world.stateHash();
  };
  EXPECT_EQ(hashWith(2), hashWith(1));
  EXPECT_EQ(hashWith(4), hashWith(1));
}

}  // namespace
