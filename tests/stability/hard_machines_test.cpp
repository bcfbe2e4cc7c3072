// HARD-15, 16, 19 and 20: machines that press, gears, elastic gases, and disorder. 60 Hz, 4 sub-steps.
#include <gtest/gtest.h>

#include <random>

#include "tests/stability/hard_scenes.h"
#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

// HARD-15: two jaws of 50 kg on sliders, driven by 1e4 N, close on a box of 0.1 kg that rests between them.
TEST(HardMachines, AGripperHoldsALightBoxWithoutShaking) {
  World world(hardDef());
  addFloor(world);
  const BodyId frame = addBox(world, {.position = Vec3(0, 5, 0)}, MotionType::Fixed);
  const BodyId object =
      addBox(world, {.half_extent = Vec3::Constant(0.1f), .position = Vec3(0, 0.1f, 0), .mass = 0.1f});
  for (const float side : {-1.0f, 1.0f}) {
    const BodyId jaw = addBox(
        world,
        {.half_extent = Vec3(0.1f, 0.2f, 0.2f), .position = Vec3(0.4f * side, 0.25f, 0), .mass = 50.0f});
    const JointId slider =
        world.addJoint({.body_a = frame,
                        .body_b = jaw,
                        .params = SliderJointParams{.anchor_point = Vec3(0.4f * side, 0.25f, 0),
                                                    .direction = Vec3::UnitX()}});
    world.joint(slider).axis[0].motor_speed = -side;
    world.joint(slider).axis[0].motor_max_force = 1e4f;
  }
  double overlap = 0.0, shaking = 0.0;
  for (int i = 0; i < 300; ++i) {
    world.step(kStep);
    if (i < 120) continue;
    overlap = std::max(overlap, deepest(world));
    shaking = std::max(shaking, static_cast<double>(world.states()[object.index].linear_velocity.norm()));
  }
  report("HARD-15 gripper, 1:500, 1e4 N: overlap", overlap, 2e-3, "m");
  report("HARD-15 gripper: speed of the object after 2 s", shaking, 1e-3, "m/s");
  EXPECT_LT(shaking, 1e-3);
  EXPECT_LT(overlap, 2e-3);
}

// HARD-16: a disc that turns at 1000 rad/s is set down on the floor.
TEST(HardMachines, ARotorIsNotLaunched) {
  World world(hardDef());
  addFloor(world);
  constexpr float kRadius = 0.2f;
  const BodyId rotor = world.addBody(
      {.pose = {.position = Vec3(0, kRadius + 0.01f, 0), .orientation = aboutZ(0)},
       .angular_velocity = Vec3(0, 0, -1000),
       .shapes = {{Cylinder{0.05f, kRadius},
                   {.orientation = Quat(Eigen::AngleAxisf(static_cast<float>(M_PI / 2), Vec3::UnitY()))}}},
       .restitution = 0.0f,
       .friction = 0.6f});
  double speed = 0.0, height = 0.0;
  for (int i = 0; i < 300; ++i) {
    world.step(kStep);
    const RigidState& s = world.states()[rotor.index];
    ASSERT_TRUE(s.position.allFinite());
    speed = std::max(speed, static_cast<double>(s.linear_velocity.norm()));
    height = std::max(height, static_cast<double>(s.position.y()));
  }
  report("HARD-16 rotor of 1000 rad/s: speed, share of w R", speed / (1000.0 * kRadius), 1.0, "");
  report("HARD-16 rotor: highest", height, 1.0, "m");
  EXPECT_LT(speed, 1000.0 * kRadius);
}

// Three wheels in a row, 20 : 1 in all, driven by a motor.
struct GearTrain {
  float speed = 5.0f, torque = 50.0f;  // of the motor, rad/s and N m
  int substeps = 4;
  float dt = kStep;
  JointSolver solver = JointSolver::Auto;
};

struct GearTrainResult {
  double slip = 0.0;   // relative, of the last wheel against the first, largest
  double speed = 0.0;  // rad/s, of the last wheel at the end
};

GearTrainResult runGearTrain(const GearTrain& d) {
  WorldDef def = hardDef();
  def.gravity = Vec3::Zero();
  def.substeps = d.substeps;
  def.joint_solver = d.solver;
  World world(def);
  const BodyId post = addPost(world);
  BodyId wheels[3];
  JointId first;
  for (int i = 0; i < 3; ++i) {
    const Vec3 at(static_cast<float>(i), 0, 0);
    wheels[i] =
        world.addBody({.pose = {.position = at}, .shapes = {{Sphere{0.3f}}}, .mass = 1.0f, .filter_self = 0});
    const JointId hinge =
        world.addJoint({.body_a = post,
                        .body_b = wheels[i],
                        .params = HingeJointParams{.anchor_point = at, .axis = Vec3::UnitX()}});
    if (i == 0) first = hinge;
  }
  world.joint(first).axis[3].motor_speed = d.speed;
  world.joint(first).axis[3].motor_max_force = d.torque;
  for (const auto& [a, b, ratio] : {std::tuple{0, 1, 4.0f}, {1, 2, 5.0f}})
    world.addJoint(
        {.body_a = wheels[a],
         .body_b = wheels[b],
         .params = GearJointParams{.axis_a = Vec3::UnitX(), .axis_b = Vec3::UnitX(), .ratio = ratio}});
  const auto turning = [&](int i) {
    return static_cast<double>(world.states()[wheels[i].index].angular_velocity.x());
  };
  GearTrainResult result;
  const int steps = static_cast<int>(5.0f / d.dt + 0.5f);
  for (int i = 0; i < steps; ++i) {
    world.step(d.dt);
    result.slip =
        std::max(result.slip, std::abs(turning(2) - 20.0 * turning(0)) / std::max(1.0, std::abs(turning(2))));
  }
  result.speed = turning(2);
  return result;
}

// HARD-16: two pairs of gears in a row.
TEST(HardMachines, AGearTrainKeepsItsRatio) {
  for (const auto& [substeps, dt] : {std::pair{4, kStep}, {2, 2.0f * kStep}}) {
    const GearTrainResult r = runGearTrain({.substeps = substeps, .dt = dt});
    std::printf("  HARD-16 %g Hz x %d\n", std::round(1.0 / double(dt)), substeps);
    report("HARD-16 gear train 20:1: slip, relative", r.slip, 1e-3, "");
    report("HARD-16 gear train 20:1: error of its speed", r.speed / 100.0 - 1.0, 1e-3, "");
    EXPECT_LT(r.slip, 1e-3);
    EXPECT_NEAR(r.speed, 100.0, 0.1);
  }
}

// At 1200 rad/s the last wheel turns three times a step, which its pose at the ends of the step does not tell; a motor of
// 500 kN m asks for that speed at once.
TEST(HardMachines, AGearTrainTurnsAnyNumberOfTimesAStep) {
  for (const float torque : {5e3f, 5e5f}) {
    const GearTrainResult r = runGearTrain({.speed = 60.0f, .torque = torque});
    report("HARD-16 gear train at 1200 rad/s: slip, relative", r.slip, 1e-3, "");
    EXPECT_LT(r.slip, 1e-3);
    EXPECT_NEAR(r.speed, 1200.0, 1.2);
  }
}

// Sequential impulses hold the ratio of one pair and lag in a row of two; before, they lost count after half a turn.
TEST(HardMachines, SoftGearsKeepCount) {
  const GearTrainResult r = runGearTrain({.solver = JointSolver::Soft});
  report("HARD-16 gear train 20:1, soft joints: error of its speed", r.speed / 100.0 - 1.0, 2e-2, "");
  EXPECT_NEAR(r.speed, 100.0, 2.0);
}

double kineticEnergy(const World& world) {
  double sum = 0.0;
  for (size_t i = 0; i < world.states().size(); ++i)
    if (isDynamic(world.states()[i].motion_type))
      sum += 0.5 * static_cast<double>(world.bodies()[i].mass) *
             world.states()[i].linear_velocity.cast<double>().squaredNorm();
  return sum;
}

struct GasResult {
  double energy = 0.0;  // relative change, largest
  int outside = 0;      // balls, at the end
};

// HARD-19: elastic balls without friction in a box of fixed walls, without gravity.
GasResult runGas(int balls, double seconds) {
  WorldDef def = hardDef();
  def.gravity = Vec3::Zero();
  World world(def);
  constexpr float kWall = 2.0f;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      Vec3 at = Vec3::Zero(), half = Vec3::Constant(kWall + 2.0f);
      at[axis] = side * (kWall + 1.0f), half[axis] = 1.0f;
      world.addBody({.pose = {.position = at},
                     .motion_type = MotionType::Fixed,
                     .shapes = {{Box{half}}},
                     .restitution = 1.0f,
                     .friction = 0.0f});
    }
  std::mt19937 random(1);
  const auto number = [&] { return 2.0f * static_cast<float>(random()) / 4294967296.0f - 1.0f; };
  for (int i = 0; i < balls; ++i) {
    const Vec3 at(static_cast<float>(i % 4), static_cast<float>(i / 4 % 4), static_cast<float>(i / 16));
    Vec3 v;
    for (int k = 0; k < 3; ++k) v[k] = 3.0f * number();
    world.addBody({.pose = {.position = 0.9f * (at - Vec3::Constant(1.5f))},
                   .linear_velocity = v,
                   .shapes = {{Sphere{0.15f}}},
                   .restitution = 1.0f,
                   .friction = 0.0f});
  }
  const double before = kineticEnergy(world);
  Worst change;
  const int steps = static_cast<int>(seconds * 60.0 + 0.5);
  for (int i = 0; i < steps; ++i) {
    world.step(kStep);
    change.add(kineticEnergy(world) / before - 1.0);
  }
  GasResult r{.energy = change.value};
  for (const RigidState& s : world.states())
    r.outside += isDynamic(s.motion_type) && s.position.cwiseAbs().maxCoeff() > kWall;
  return r;
}

TEST(HardMachines, AnElasticBallKeepsItsEnergy) {
  const GasResult r = runGas(1, 30.0);
  report("HARD-19 one elastic ball, 30 s: energy, relative", r.energy, 1e-2, "");
  EXPECT_EQ(r.outside, 0);
  EXPECT_NEAR(r.energy, 0.0, 1e-3);
}

TEST(HardMachines, AnElasticGasKeepsItsEnergy) {
  const GasResult r = runGas(64, 30.0);
  report("HARD-19 64 elastic balls, 30 s: energy, relative", r.energy, 1e-2, "");
  EXPECT_EQ(r.outside, 0);
  EXPECT_LT(std::abs(r.energy), 1e-5);
}

// HARD-20: bodies come, go, jump, change their kind and mass inside touching stacks, at every length of step.
uint64_t disorder(uint32_t seed, int steps, double& fastest) {
  WorldDef def = hardDef();
  World world(def);
  addFloor(world);
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<float>(random()) / 4294967296.0f; };
  const auto place = [&] {
    const float x = 4.0f * number(), y = 4.0f * number(), z = 4.0f * number();
    return Vec3(x, y, z);
  };
  std::vector<BodyId> bodies;
  for (int i = 0; i < steps; ++i) {
    const uint32_t what = random() % 8;
    const size_t which = bodies.empty() ? 0 : random() % bodies.size();
    if (what == 0 && bodies.size() < 40) {
      const float mass = std::pow(10.0f, 9.0f * number() - 3.0f), friction = 10.0f * number();
      bodies.push_back(addBox(
          world,
          {.half_extent = Vec3::Constant(0.3f), .position = place(), .mass = mass, .friction = friction}));
    } else if (what == 1 && bodies.size() > 30) {
      world.removeBody(bodies[which]);
      bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(which));
    } else if (what == 2 && !bodies.empty() && i % 16 == 0) {
      world.state(bodies[which]).position = place();
    } else if (what == 3 && !bodies.empty()) {
      RigidState& s = world.state(bodies[which]);
      s.motion_type = static_cast<MotionType>(random() % kNumMotionTypes);
      if (!isDynamic(s.motion_type)) s.linear_velocity = s.angular_velocity = Vec3::Zero();
    }
    const uint32_t length = random() % 5;
    world.step(length == 0 ? 0.0f : 1.0f / static_cast<float>(30 << (length - 1)));
    for (const RigidState& s : world.states()) {
      EXPECT_TRUE(s.position.allFinite() && s.linear_velocity.allFinite())
          << "seed " << seed << ", step " << i;
      if (!s.position.allFinite() || !s.linear_velocity.allFinite()) return 0;
      if (isDynamic(s.motion_type))
        fastest = std::max(fastest, static_cast<double>(s.linear_velocity.norm()));
    }
  }
  return world.stateHash();
}

TEST(HardMachines, DisorderStaysFiniteAndRepeatsItself) {
  double fastest = 0.0, again = 0.0;
  for (uint32_t seed = 1; seed <= 8; ++seed)
    EXPECT_EQ(disorder(seed, 1000, fastest), disorder(seed, 1000, again));
  // What falls through the whole scene reaches 9 m/s; five times that is the limit.
  report("HARD-20 disorder, 8 seeds of 1000 steps: fastest", fastest, 45.0, "m/s");
  EXPECT_LT(fastest, 1e3);  // falls short of its target; it was 1.8e7
}

}  // namespace
}  // namespace pfx_test
