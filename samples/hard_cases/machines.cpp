// HARD-12, 14 and 19: a chain with a huge load, loops of joints, elastic balls.
#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "samples/hard_cases/witness.h"
#include "samples/shared/builders.h"

namespace samples::hard_cases {
namespace {

using namespace pfx;

BodyId addHook(World& world, const Vec3& at) {
  return world.addBody({.name = "hook",
                        .pose = {.position = at},
                        .motion_type = MotionType::Fixed,
                        .shapes = {shape(Sphere{0.15f})},
                        .filter_self = 0});
}

// Two hundred links of 50 g hold 500 kg that swings from horizontal.
struct HeavyChain final : WitnessedScene {
  static constexpr int kLinks = 200;
  static constexpr float kPitch = 0.1f;  // m

  void fill(World& world) override {
    BodyId last = addHook(world, Vec3::Zero());
    const auto point = [](float links) { return Vec3(kPitch * links, 0, 0); };
    for (int i = 0; i < kLinks; ++i) {
      const auto at = static_cast<float>(i);
      const BodyId link = world.addBody({.name = "link",
                                         .pose = {.position = point(at + 0.5f)},
                                         .shapes = {shape(Capsule{0.04f, 0.025f})},
                                         .mass = 0.05f,
                                         .filter_self = 0});
      world.addJoint({.body_a = last, .body_b = link, .params = BallJointParams{.anchor_point = point(at)}});
      last = link;
    }
    const BodyId ball = world.addBody({.name = "load",
                                       .pose = {.position = point(kLinks)},
                                       .shapes = {shape(Sphere{0.8f})},
                                       .mass = 500.0f,
                                       .filter_self = 0});
    world.addJoint({.body_a = last, .body_b = ball, .params = FixedJointParams{.anchor_point = point(kLinks)}});
  }
  std::vector<Reading> readings(const World&) const override {
    return {{"widest gap, share of a link", "", witness().gap / double(kPitch), 0.02}};
  }
};

// A plate on four parallel legs, a door on three hinges, and a crank that drives a rocker: all have more joints than
// they need, or pass through singular poses.
struct Loops final : WitnessedScene {
  void fill(World& world) override {
    const BodyId ground = addGround(world);
    addPlate(world, ground);
    addDoor(world, ground);
    addCrank(world, ground);
  }

  static BodyId addBar(World& world, const Vec3& from, const Vec3& to, float mass) {
    const Quat turn = Quat::FromTwoVectors(Vec3::UnitX(), to - from).normalized();
    return world.addBody({.name = "bar",
                          .pose = {0.5f * (from + to), turn},
                          .shapes = {shape(Box{Vec3(0.5f * (to - from).norm(), 0.06f, 0.06f)})},
                          .mass = mass,
                          .filter_self = 0});
  }
  static JointId hinge(World& world, BodyId a, BodyId b, const Vec3& at, const Vec3& axis) {
    return world.addJoint({.body_a = a, .body_b = b, .params = HingeJointParams{.anchor_point = at, .axis = axis}});
  }
  static void addPlate(World& world, BodyId ground) {
    const BodyId plate = world.addBody({.name = "plate",
                                        .pose = {.position = Vec3(-4, 2.5f, 0)},
                                        .linear_velocity = Vec3(3, 0, 0),
                                        .shapes = {shape(Box{Vec3(1, 0.1f, 1)})},
                                        .mass = 10.0f,
                                        .filter_self = 0});
    for (const float x : {-4.9f, -3.1f})
      for (const float z : {-0.9f, 0.9f}) {
        const Vec3 upper(x, 4.5f, z), lower(x, 2.5f, z);
        const BodyId leg = addBar(world, upper, lower, 1.0f);
        world.state(leg).linear_velocity = Vec3(1.5f, 0, 0);
        world.state(leg).angular_velocity = Vec3(0, 0, 1.5f);
        hinge(world, ground, leg, upper, Vec3::UnitZ());
        hinge(world, leg, plate, lower, Vec3::UnitZ());
      }
  }
  static void addDoor(World& world, BodyId ground) {
    const BodyId door = world.addBody({.name = "door",
                                       .pose = {.position = Vec3(0.5f, 2.2f, 0)},
                                       .linear_velocity = Vec3(0, 0, -1),
                                       .angular_velocity = Vec3(0, 2, 0),
                                       .shapes = {shape(Box{Vec3(0.5f, 1, 0.03f)})},
                                       .mass = 20.0f,
                                       .filter_self = 0});
    for (const float y : {1.4f, 2.2f, 3.0f}) hinge(world, ground, door, {0, y, 0}, Vec3::UnitY());
  }
  // The crank turns all the way round, so that crank and coupler come into line twice a turn.
  static void addCrank(World& world, BodyId ground) {
    const Vec3 pivot(3, 1.5f, 0), pin(3, 2.3f, 0), joint(5.2f, 3.4f, 0), support(5.6f, 1.5f, 0);
    const BodyId crank = addBar(world, pivot, pin, 2.0f), coupler = addBar(world, pin, joint, 2.0f);
    const BodyId rocker = addBar(world, joint, support, 2.0f);
    const JointId motor = hinge(world, ground, crank, pivot, Vec3::UnitZ());
    hinge(world, crank, coupler, pin, Vec3::UnitZ());
    hinge(world, coupler, rocker, joint, Vec3::UnitZ());
    hinge(world, rocker, ground, support, Vec3::UnitZ());
    world.joint(motor).axis[3].motor_speed = 4.0f;
    world.joint(motor).axis[3].motor_max_force = 200.0f;
  }
  std::vector<Reading> readings(const World& world) const override {
    double force = 0.0;
    for (const Joint& j : world.joints()) force = std::max(force, double(j.force.norm()));
    return {{"widest gap", "m", witness().gap, 1e-4}, {"largest force of a joint", "N", force, 5e3}};
  }
};

// Sixty-four balls that lose nothing in a box without weight: their energy must stay.
struct ElasticBalls final : WitnessedScene {
  static constexpr float kHalf = 3.0f, kRadius = 0.3f, kSpeed = 5.0f;
  double energy0 = 0.0;

  void fill(World& world) override {
    std::vector<Shape> walls;
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-1.0f, 1.0f}) {
        Vec3 half = Vec3::Constant(kHalf + 0.2f), at = Vec3::Zero();
        half[axis] = 0.1f, at[axis] = side * (kHalf + 0.1f);
        if (axis != 2 || side < 0.0f) walls.push_back(shape(Box{half}, {.position = at}));
      }
    // The front wall is a grating, so that one can look in.
    for (int i = -6; i <= 6; ++i)
      walls.push_back(shape(Box{Vec3(0.04f, kHalf, 0.04f)}, {.position = Vec3(0.5f * static_cast<float>(i), 0, kHalf + 0.04f)}));
    world.addBody({.name = "box", .motion_type = MotionType::Fixed, .shapes = walls, .restitution = 1.0f, .friction = 0.0f});
    for (int i = 0; i < 64; ++i) {
      const SinCos way = sincos(2.3999632f * static_cast<float>(i));
      const float rise = static_cast<float>(i) / 32.0f - 1.0f + 1.0f / 64.0f, flat = std::sqrt(1.0f - rise * rise);
      world.addBody({.name = "ball",
                     .pose = {.position = 1.4f * Vec3(static_cast<float>(i % 4) - 1.5f, static_cast<float>(i / 4 % 4) - 1.5f,
                                                      static_cast<float>(i / 16) - 1.5f)},
                     .linear_velocity = kSpeed * Vec3(flat * way.cos, rise, flat * way.sin),
                     .shapes = {shape(Sphere{kRadius})},
                     .restitution = 1.0f,
                     .friction = 0.0f});
    }
    energy0 = energy(world);
  }
  static double energy(const World& world) {
    double sum = 0.0;
    for (size_t i = 0; i < world.states().size(); ++i)
      if (isDynamic(world.states()[i].motion_type))
        sum += 0.5 * double(world.bodies()[i].mass) * world.states()[i].linear_velocity.cast<double>().squaredNorm();
    return sum;
  }
  std::vector<Reading> readings(const World& world) const override {
    return {{"change of energy", "", std::abs(energy(world) / energy0 - 1.0), 0.01}};
  }
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

std::vector<SceneEntry> machineScenes() {
  const std::string_view sample = "hard_cases";
  return {
      {.sample = sample,
       .name = "heavy_chain",
       .shows = "200 links of 50 g hold 500 kg, and none stretches",
       .camera = {.target = {6.5f, -8.5f, 0}, .distance = 38.0f, .yaw_deg = 14.0f, .pitch_deg = 6.0f},
       .frames = {0, 90, 150},
       .world = {},
       .make = make<HeavyChain>},
      {.sample = sample,
       .name = "loops",
       .shows = "a plate on four legs, a door on three hinges, a crank and its rocker: loops of joints that must fit",
       .camera = {.target = {0.2f, 2.3f, 0}, .distance = 15.0f, .yaw_deg = 18.0f, .pitch_deg = 12.0f},
       .frames = {0, 40, 200},
       .world = {},
       .make = make<Loops>},
      {.sample = sample,
       .name = "elastic_balls",
       .shows = "64 balls that lose nothing; their energy stays for thousands of collisions",
       .camera = {.target = {0, 0, 0}, .distance = 13.5f, .yaw_deg = 20.0f, .pitch_deg = 14.0f},
       .frames = {0, 60, 300},
       .world = {.gravity = Vec3::Zero()},
       .make = make<ElasticBalls>},
  };
}

}  // namespace samples::hard_cases
