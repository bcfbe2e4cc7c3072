// HARD-14: closed loops of joints, with more rows than they need or poses in which they lose one. 60 Hz, 4 sub-steps.
#include <gtest/gtest.h>

#include <array>
#include <span>

#include "tests/stability/hard_scenes.h"
#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

BodyId addBar(World& world, const Vec3& from, const Vec3& to, float mass) {
  const Quat turn = Quat::FromTwoVectors(Vec3::UnitX(), to - from).normalized();
  return world.addBody({.name = "bar",
                        .pose = {0.5f * (from + to), turn},
                        .shapes = {{Box{Vec3(0.5f * (to - from).norm(), 0.06f, 0.06f)}}},
                        .mass = mass,
                        .filter_self = 0});
}

JointId addHinge(World& world, BodyId a, BodyId b, const Vec3& at, const Vec3& axis) {
  return world.addJoint({.body_a = a, .body_b = b, .params = HingeJointParams{.anchor_point = at, .axis = axis}});
}

struct LoopResult {
  double gap = 0.0;     // m
  double force = 0.0;   // N, in any joint
  double torque = 0.0;  // N m, beside that of the forces
  double turned = 0.0;  // rad, of the crank
};

// Crank, coupler and rocker in a plane, by the places of their joints; a motor drives the crank.
struct FourBar {
  Vec3 pivot, pin, elbow, support;
  float speed = 4.0f, most_torque = 200.0f;  // of the motor, rad/s and N m
};

LoopResult runFourBar(const FourBar& d, double seconds) {
  World world(hardDef());
  const BodyId ground = addPost(world);
  const BodyId crank = addBar(world, d.pivot, d.pin, 2.0f), coupler = addBar(world, d.pin, d.elbow, 2.0f);
  const BodyId rocker = addBar(world, d.elbow, d.support, 2.0f);
  const JointId motor = addHinge(world, ground, crank, d.pivot, Vec3::UnitZ());
  addHinge(world, crank, coupler, d.pin, Vec3::UnitZ());
  addHinge(world, coupler, rocker, d.elbow, Vec3::UnitZ());
  addHinge(world, rocker, ground, d.support, Vec3::UnitZ());
  world.joint(motor).axis[3].motor_speed = d.speed;
  world.joint(motor).axis[3].motor_max_force = d.most_torque;
  LoopResult r;
  const int steps = static_cast<int>(seconds * 60.0 + 0.5);
  for (int i = 0; i < steps; ++i) {
    world.step(kStep);
    r.gap = std::max(r.gap, largestGap(world));
    r.turned += static_cast<double>(kStep * world.states()[crank.index].angular_velocity.z());
    for (const Joint& j : world.joints()) {
      r.force = std::max(r.force, static_cast<double>(j.force.norm()));
      r.torque = std::max(r.torque, static_cast<double>(j.torque.norm()));
    }
  }
  return r;
}

TEST(HardLoops, ACrankTurnsItsRockerForAHundredSeconds) {
  const LoopResult r = runFourBar({{3, 1.5f, 0}, {3, 2.3f, 0}, {5.2f, 3.4f, 0}, {5.6f, 1.5f, 0}}, 100.0);
  report("HARD-14 crank and rocker, 100 s: gap", r.gap, 1e-4, "m");
  report("HARD-14 crank and rocker: error of the angle", r.turned / 400.0 - 1.0, 1e-2, "");
  report("HARD-14 crank and rocker: force", r.force, 2e3, "N");
  report("HARD-14 crank and rocker: torque", r.torque, 2e3, "N m");
  EXPECT_LT(r.gap, 1e-4);
  EXPECT_NEAR(r.turned, 400.0, 4.0);
  EXPECT_LT(r.force, 2e3);
  EXPECT_LT(r.torque, 2e3);
}

// A parallelogram: all four joints come into one line twice a turn, where the loop loses a row and could fold.
TEST(HardLoops, AParallelogramCrossesItsSingularPose) {
  const LoopResult r = runFourBar({{0, 0, 0}, {0, 1, 0}, {2, 1, 0}, {2, 0, 0}}, 100.0);
  report("HARD-14 parallelogram, 100 s: gap", r.gap, 1e-4, "m");
  std::printf("  HARD-14 parallelogram: turns %.1f (the motor asks for 63.7)\n", r.turned / (2.0 * M_PI));
  report("HARD-14 parallelogram: force", r.force, 5e3, "N");
  EXPECT_LT(r.gap, 1e-4);
  EXPECT_LT(r.force, 5e3);
  EXPECT_NEAR(r.turned, 400.0, 4.0);
}

// A closed chain of hinges in space after Denavit and Hartenberg: link i is as long as `length`, its next axis is turned
// by `twist` about it, and the hinge stands at `angle`.
struct SpatialLink {
  double length, twist, angle;
};

struct SpatialResult {
  double closure = 0.0;  // m, by which the chain misses its start as given
  double gap = 0.0;      // m
  double energy = 0.0;   // relative change after the first step
  double turned = 0.0;   // rad, by the second link, path length
};

// The first link is fixed, the second is set turning; no weight.
SpatialResult runSpatialLoop(std::span<const SpatialLink> links, double seconds) {
  std::vector<Vec3d> points, axes;
  Vec3d at = Vec3d::Zero();
  Quatd frame = Quatd::Identity();
  for (const SpatialLink& l : links) {
    points.push_back(at), axes.push_back(frame * Vec3d::UnitZ());
    frame = frame * Quatd(Eigen::AngleAxisd(l.angle, Vec3d::UnitZ()));
    at += frame * Vec3d(l.length, 0, 0);
    frame = frame * Quatd(Eigen::AngleAxisd(l.twist, Vec3d::UnitX()));
  }
  SpatialResult r;
  r.closure = at.norm() + (frame * Vec3d::UnitZ() - Vec3d::UnitZ()).norm();
  WorldDef def = hardDef();
  def.gravity = Vec3::Zero();
  World world(def);
  const size_t n = links.size();
  std::vector<BodyId> bodies;
  for (size_t i = 0; i < n; ++i) {
    const Vec3 from = points[i].cast<float>(), to = points[(i + 1) % n].cast<float>();
    bodies.push_back(i == 0 ? addPost(world, 0.5f * (from + to)) : addBar(world, from, to, 1.0f));
  }
  for (size_t i = 0; i < n; ++i)
    addHinge(world, bodies[(i + n - 1) % n], bodies[i], points[i].cast<float>(), axes[i].cast<float>());
  const Vec3 spin = 2.0f * axes[1].cast<float>();
  RigidState& s = world.state(bodies[1]);
  s.angular_velocity = spin;
  s.linear_velocity = spin.cross(s.position - points[1].cast<float>());
  const auto kinetic = [&] {
    double sum = 0.0;
    for (size_t i = 1; i < n; ++i) {
      const RigidState& b = world.states()[bodies[i].index];
      const Mat3 inertia = world.bodies()[bodies[i].index].inertia;
      const Vec3 w = b.orientation.conjugate() * b.angular_velocity;
      sum += 0.5 * static_cast<double>(b.linear_velocity.squaredNorm() + w.dot(inertia * w));
    }
    return sum;
  };
  world.step(kStep);  // what the loop does not allow is lost here
  const double e0 = kinetic();
  const int steps = static_cast<int>(seconds * 60.0 + 0.5);
  Worst change;
  for (int i = 0; i < steps; ++i) {
    world.step(kStep);
    r.gap = std::max(r.gap, largestGap(world));
    r.turned += static_cast<double>(kStep * world.states()[bodies[1].index].angular_velocity.norm());
    change.add(kinetic() / e0 - 1.0);
  }
  r.energy = change.value;
  return r;
}

// Opposite links are alike, and their lengths go as the sines of their twists; only then do four hinges in space move.
TEST(HardLoops, BennettsLoopOfFourHingesTurns) {
  const double a = 1.0, alpha = M_PI / 6, beta = M_PI / 2, b = a * std::sin(beta) / std::sin(alpha);
  const double first = 1.0;
  const double second =
      2.0 * std::atan(std::sin(0.5 * (beta + alpha)) / std::sin(0.5 * (beta - alpha)) / std::tan(0.5 * first));
  // the angle of a hinge precedes its link: hinge 1 stands between links b and a
  const std::array<SpatialLink, 4> links = {
      SpatialLink{a, alpha, first}, {b, beta, second}, {a, alpha, -first}, {b, beta, -second}};
  const SpatialResult r = runSpatialLoop(links, 100.0);
  ASSERT_LT(r.closure, 1e-9);
  report("HARD-14 Bennett, 100 s: gap", r.gap, 1e-4, "m");
  report("HARD-14 Bennett: energy, relative", r.energy, 1e-3, "");
  report("HARD-14 Bennett: way of a link", r.turned, 1e3, "rad");
  EXPECT_LT(r.gap, 1e-4);
  EXPECT_LT(std::abs(r.energy), 1e-3);
}

// Bricard's trihedral loop with twists of a right angle: six bars that turn inside out for ever.
TEST(HardLoops, BricardsLoopOfSixHingesTurnsInsideOut) {
  std::array<SpatialLink, 6> links;
  for (size_t i = 0; i < 6; ++i) links[i] = {1.0, i % 2 == 0 ? 0.5 * M_PI : -0.5 * M_PI, 0.5 * M_PI};
  const SpatialResult r = runSpatialLoop(links, 100.0);
  ASSERT_LT(r.closure, 1e-9);
  report("HARD-14 Bricard, 100 s: gap", r.gap, 1e-4, "m");
  report("HARD-14 Bricard: energy, relative", r.energy, 1e-3, "");
  report("HARD-14 Bricard: way of a link", r.turned, 1e3, "rad");
  EXPECT_LT(r.gap, 1e-4);
  EXPECT_LT(std::abs(r.energy), 1e-3);
}

}  // namespace
}  // namespace pfx_test
