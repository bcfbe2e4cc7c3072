// Sample 6_joint: every kind of joint, ragdolls, and a machine of pulleys and rope.
#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/rigid_body/rotation_update.h"
#include "samples/registry.h"
#include "samples/shared/builders.h"
#include "samples/shared/ragdoll.h"

namespace samples {
namespace {

using namespace pfx;

// Six pairs of boxes, end to end along Z, the first of each fixed. What the joint leaves free, gravity shows.
struct BasicJoints final : Scene {
  static constexpr float kPitch = 3.0f, kHeight = 5.0f;
  static constexpr float kHalfLength = 1.0f, kGap = 0.1f;

  void build(World& world) override {
    addGround(world);
    const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
    const Vec3 at = anchor();
    const Quat level = Quat::Identity();
    addPair(world, "ball", 0, level, BallJointParams{.anchor_point = at, .damping = 0.02f});
    addPair(world, "swing twist", 1, level, SwingTwistJointParams{.anchor_point = at, .twist_axis = z});
    addPair(world, "hinge", 2, level,
            HingeJointParams{.anchor_point = at, .axis = x, .lower_angle = -0.5f, .upper_angle = 0.7f});
    const Quat downhill = expMap(0.5f * x);
    addPair(world, "slider", 3, downhill,
            SliderJointParams{.anchor_point = downhill * at,
                              .direction = downhill * z,
                              .lower_distance = 0.0f,
                              .upper_distance = 1.0f,
                              .damping = 0.02f});
    addPair(world, "fixed", 4, level, FixedJointParams{.anchor_point = at, .bias = 0.6f});
    addPair(world, "universal", 5, level, UniversalJointParams{.anchor_point = at, .axis = z});
  }

 private:
  static Vec3 anchor() { return Vec3(0, 0, kHalfLength + 0.5f * kGap); }

  // `params` is given for a pair whose first box stands at the origin.
  static void addPair(World& world, const std::string& name, int place, const Quat& turn,
                      JointParams params) {
    const Vec3 offset((static_cast<float>(place) - 2.5f) * kPitch, kHeight, 0.0f);
    const std::vector<Shape> box = {shape(Box{Vec3(0.25f, 0.7f, kHalfLength)})};
    const BodyId a = world.addBody({.name = name + " base",
                                    .pose = {offset, turn},
                                    .motion_type = MotionType::Fixed,
                                    .shapes = box,
                                    .mass = 5.0f});
    const BodyId b = world.addBody({.name = name + " arm",
                                    .pose = {offset + turn * (2.0f * anchor()), turn},
                                    .shapes = box,
                                    .mass = 5.0f});
    std::visit(
        [&](auto& p) {
          if constexpr (requires { p.anchor_point; }) p.anchor_point += offset;
        },
        params);
    world.addJoint({.name = name, .body_a = a, .body_b = b, .params = params});
  }
};

struct Ragdolls final : Scene {
  void build(World& world) override {
    addGround(world);
    for (int i = 0; i < 5; ++i) {
      const float height = 0.4f * static_cast<float>(5 - i);
      world.addBody({.name = "stair " + std::to_string(i),
                     .pose = {.position = Vec3(0, 0.5f * height, 2.0f * static_cast<float>(i) - 4.0f)},
                     .motion_type = MotionType::Fixed,
                     .shapes = {shape(Box{Vec3(9.0f, 0.5f * height, 1.0f)})}});
    }
    for (int i = 0; i < 5; ++i) {
      const float angle = 0.35f * static_cast<float>(i - 2);
      addRagdoll(
          world, "ragdoll " + std::to_string(i),
          {.position = Vec3(3.4f * static_cast<float>(i - 2), 5.2f + 0.5f * static_cast<float>(i), -3.6f),
           .orientation = expMap(angle * Vec3::UnitX())});
    }
  }
};

// A rope over two pulleys, ten kilograms at one end, two at the other.
struct PulleyMachine final : Scene {
  static constexpr float kPulleyX = 2.0f, kPulleyY = 7.0f;
  static constexpr float kPath = 0.64f;  // m, radius at which the rope runs over a pulley
  static constexpr float kPitch = 0.4f;  // m, of the rope's links
  static constexpr int kLinks = 32;

  void build(World& world) override {
    const BodyId ground = addGround(world);
    for (const float side : {-1.0f, 1.0f}) addPulley(world, ground, side);
    addRope(world);
  }

 private:
  static void addPulley(World& world, BodyId ground, float side) {
    const Quat along_z = expMap(-0.5f * kPi * Vec3::UnitY());
    const Vec3 center(side * kPulleyX, kPulleyY, 0);
    const auto disc = [&](float z) {
      return shape(Cylinder{0.05f, 0.95f}, {.position = Vec3(0, 0, z), .orientation = along_z});
    };
    const BodyId pulley = world.addBody(
        {.name = side < 0 ? "left pulley" : "right pulley",
         .pose = {.position = center},
         .shapes = {shape(Capsule{0.3f, 0.5f}, {.orientation = along_z}), disc(-0.3f), disc(0.3f)},
         .mass = 10.0f});
    world.addJoint(
        {.name = side < 0 ? "left bearing" : "right bearing",
         .body_a = ground,
         .body_b = pulley,
         .params = HingeJointParams{.anchor_point = center, .axis = Vec3::UnitZ(), .damping = 0.01f}});
  }

  // Point of the rope's path, s metres from its middle at the top between the pulleys.
  static Vec3 path(float s) {
    const float side = s < 0.0f ? -1.0f : 1.0f, d = std::abs(s);
    const float arc = 0.5f * kPi * kPath;
    if (d < kPulleyX) return Vec3(side * d, kPulleyY + kPath, 0);
    if (d < kPulleyX + arc) {
      const SinCos turn = sincos((d - kPulleyX) / kPath);
      return Vec3(side * (kPulleyX + kPath * turn.sin), kPulleyY + kPath * turn.cos, 0);
    }
    return Vec3(side * (kPulleyX + kPath), kPulleyY - (d - kPulleyX - arc), 0);
  }

  static BodyId addLink(World& world, int index, const Vec3& from, const Vec3& to) {
    const Quat turn = Quat::FromTwoVectors(Vec3::UnitX(), to - from);
    return world.addBody({.name = "link " + std::to_string(index),
                          .pose = {0.5f * (from + to), turn.normalized()},
                          .shapes = {shape(Capsule{0.13f, 0.08f})},
                          .mass = 0.5f,
                          .friction = 0.8f});
  }

  static void addRope(World& world) {
    const float start = -0.5f * static_cast<float>(kLinks) * kPitch;
    const auto node = [&](int i) { return path(start + static_cast<float>(i) * kPitch); };
    const auto weight = [&](const char* name, int end, float radius, float mass) {
      return addBody(world, name, Sphere{radius}, node(end) - Vec3(0, radius, 0), mass);
    };
    BodyId last = weight("ten kilograms", 0, 0.5f, 10.0f);
    for (int i = 0; i < kLinks; ++i) {
      const BodyId next = addLink(world, i, node(i), node(i + 1));
      world.addJoint({.name = "rope " + std::to_string(i),
                      .body_a = last,
                      .body_b = next,
                      .params = ropeJoint(node(i), node(i + 1) - node(i))});
      last = next;
    }
    const BodyId light = weight("two kilograms", kLinks, 0.3f, 2.0f);
    world.addJoint({.name = "rope end",
                    .body_a = last,
                    .body_b = light,
                    .params = ropeJoint(node(kLinks), node(kLinks) - node(kLinks - 1))});
  }

  static SwingTwistJointParams ropeJoint(const Vec3& at, const Vec3& along) {
    return {.anchor_point = at, .twist_axis = along, .swing_upper_angle = 1.2f, .damping = 0.1f};
  }
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

std::vector<SceneEntry> jointScenes() {
  const std::string_view sample = "6_joint";
  return {
      {.sample = sample,
       .name = "basic_joints",
       .shows = "ball, swing twist, hinge, slider, fixed and universal joint: what each one leaves free, "
                "gravity uses",
       .camera = {.target = Vec3(0.0f, 4.3f, 1.2f), .distance = 19.0f, .yaw_deg = 32.0f, .pitch_deg = 14.0f},
       .frames = {0, 40, 240},
       .world = {},
       .make = make<BasicJoints>},
      {.sample = sample,
       .name = "ragdolls",
       .shows = "five ragdolls tumble down the stairs; no knee and no elbow bends backwards",
       .camera = {.target = Vec3(0.0f, 2.0f, 0.0f), .distance = 22.0f, .yaw_deg = 28.0f, .pitch_deg = 18.0f},
       .frames = {0, 60, 300},
       .world = {},
       .make = make<Ragdolls>},
      {.sample = sample,
       .name = "pulleys",
       .shows = "a rope of 32 links runs over two pulleys and does not stretch",
       .camera = {.target = Vec3(0.0f, 4.6f, 0.0f), .distance = 16.0f, .yaw_deg = 18.0f, .pitch_deg = 8.0f},
       .frames = {0, 60, 130},
       .world = {},
       .make = make<PulleyMachine>},
  };
}

}  // namespace samples
