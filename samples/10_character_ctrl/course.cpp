#include "samples/10_character_ctrl/course.h"

#include <array>

#include "pfx/base_level/math/trig.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

constexpr float kDeck = 1.8f;                          // m, height of the decks
constexpr float kNear = -0.45f, kFar = 2.25f;          // m, the platform's ends
constexpr float kPeriod = 8.0f;                        // s, of the platform
constexpr float kBarSpeed = 0.9f, kTableSpeed = 0.7f;  // rad/s
const Vec3 kBarAt(-7.0f, 0.9f, -1.6f);

BodyId addFixed(World& world, const char* name, const Vec3& low, const Vec3& high) {
  return world.addBody({.name = name,
                        .pose = {.position = 0.5f * (low + high)},
                        .motion_type = MotionType::Fixed,
                        .shapes = {shape(Box{0.5f * (high - low)})}});
}

// A plank of 60 degrees, from the edge of the far deck down to the ground.
void addChute(World& world) {
  const float angle = kPi / 3.0f, half = 0.5f * kDeck / sin(angle);
  const Quat turn = rotation(Vec3::UnitX(), -angle);
  const Vec3 up = turn * Vec3::UnitY(), along = turn * Vec3::UnitZ();
  const Vec3 top(4.2f, kDeck, 3.0f);
  world.addBody({.name = "chute",
                 .pose = {top - half * along - 0.2f * up, turn},
                 .motion_type = MotionType::Fixed,
                 .shapes = {shape(Box{Vec3(1.0f, 0.2f, half)})}});
}

void addStations(World& world) {
  for (int i = 0; i < 6; ++i) {
    const float x = -6.0f + 0.35f * static_cast<float>(i), y = 0.3f * static_cast<float>(i + 1);
    addFixed(world, "step", Vec3(x, 0.0f, 3.0f), Vec3(x + 0.35f, y, 5.0f));
  }
  addFixed(world, "near deck", Vec3(-3.9f, 0.0f, 3.0f), Vec3(-1.4f, kDeck, 5.0f));
  addFixed(world, "far deck", Vec3(3.2f, 0.0f, 3.0f), Vec3(5.2f, kDeck, 5.0f));
  addChute(world);
  addFixed(world, "hurdle", Vec3(3.0f, 0.0f, -5.0f), Vec3(3.12f, 0.45f, -3.0f));
  addFixed(world, "tunnel", Vec3(-1.8f, 0.0f, -5.0f), Vec3(0.2f, 1.6f, -4.6f));
  addFixed(world, "tunnel", Vec3(-1.8f, 0.0f, -3.4f), Vec3(0.2f, 1.6f, -3.0f));
  addFixed(world, "tunnel", Vec3(-1.8f, 1.25f, -4.6f), Vec3(0.2f, 1.6f, -3.4f));
  world.addBody({.name = "crate",
                 .pose = {.position = Vec3(-3.4f, 0.45f, -4.0f)},
                 .shapes = {shape(Box{Vec3::Constant(0.45f)})},
                 .mass = 20.0f});
  addWall(world, Vec3(0.6f, 0.0f, 0.0f), {.rows = 5, .half_extent = 0.2f, .mass = 1.0f});
}

BodyId addScripted(World& world, const char* name, const Transform& pose, const Shape& form) {
  return world.addBody({.name = name, .pose = pose, .motion_type = MotionType::Keyframe, .shapes = {form}});
}

using Until = Leg::Until;

const std::array kHeroWay = {
    Leg{.to = {-6.6f, 0.0f, 4.0f}},
    Leg{.to = {-1.8f, 0.0f, 4.0f}, .seconds = 10.0f},  // up the stairs
    Leg{.to = {-1.8f, 0.0f, 4.0f}, .until = Until::PlatformNear, .seconds = 9.0f},
    Leg{.to = {-0.45f, 0.0f, 4.0f}, .until = Until::Time, .seconds = 0.9f},      // onto it
    Leg{.to = {}, .speed = 0.0f, .until = Until::PlatformFar, .seconds = 9.0f},  // carried
    Leg{.to = {4.2f, 0.0f, 4.0f}},
    Leg{.to = {4.2f, 0.0f, 1.6f}, .speed = 0.3f, .seconds = 4.0f},         // slowly, to slide down the chute
    Leg{.to = {4.2f, 0.0f, 3.5f}, .until = Until::Time, .seconds = 2.0f},  // not up it
    Leg{.to = {2.8f, 0.0f, 0.3f}},
    Leg{.to = {-1.4f, 0.0f, 0.0f}, .seconds = 3.0f, .run = true},  // through the boxes
    Leg{.to = {-1.4f, 0.0f, -1.9f}},
    Leg{.to = {6.2f, 0.0f, -2.2f}, .run = true},
    Leg{.to = {6.2f, 0.0f, -4.0f}},
    Leg{.to = {4.7f, 0.0f, -4.0f}, .run = true},
    Leg{.to = {1.4f, 0.0f, -4.0f}, .seconds = 2.0f, .run = true, .jump = true},  // over the hurdle
    Leg{.to = {0.9f, 0.0f, -4.0f}},
    Leg{.to = {-2.3f, 0.0f, -4.0f}, .crouch = true},                         // through the tunnel
    Leg{.to = {-5.4f, 0.0f, -4.0f}, .until = Until::Time, .seconds = 2.6f},  // behind the crate
    Leg{.to = {-4.6f, 0.0f, -1.4f}},
    Leg{.to = {}, .speed = 0.0f, .until = Until::Time, .seconds = 0.8f, .crouch = true},
    Leg{.to = {-4.6f, 0.0f, -1.4f}, .until = Until::Time, .seconds = 1.4f, .jump = true},
    Leg{.to = {-4.0f, 0.0f, 1.45f}},
    Leg{.to = {-7.6f, 0.0f, 1.45f}, .seconds = 5.0f},
    Leg{.to = {-7.6f, 0.0f, 4.0f}},
};

const std::array kWalkerWay = {
    Leg{.to = {-5.8f, 0.0f, 1.5f}, .seconds = 9.0f},
    Leg{.to = {3.2f, 0.0f, 1.5f}, .seconds = 9.0f},
};

}  // namespace

std::span<const Leg> heroWay() { return kHeroWay; }
std::span<const Leg> walkerWay() { return kWalkerWay; }

Transform Course::platformPose(float t) const {
  const float x = 0.5f * (kNear + kFar) + 0.5f * (kNear - kFar) * cos(2.0f * kPi * t / kPeriod);
  return {Vec3(x, kDeck - 0.12f, 4.0f), Quat::Identity()};
}

Transform Course::barPose(float t) const { return {kBarAt, rotation(Vec3::UnitY(), kBarSpeed * t)}; }

Transform Course::turntablePose(float t) const {
  return {kTurntableAt, rotation(Vec3::UnitY(), kTableSpeed * t) * rotation(Vec3::UnitZ(), 0.5f * kPi)};
}

Course addCourse(World& world) {
  addGround(world);
  addStations(world);
  Course course;
  course.platform =
      addScripted(world, "platform", course.platformPose(0.0f), shape(Box{Vec3(0.9f, 0.12f, 0.9f)}));
  course.bar = addScripted(world, "bar", course.barPose(0.0f), shape(Box{Vec3(1.7f, 0.15f, 0.15f)}));
  course.turntable = addScripted(world, "turntable", course.turntablePose(0.0f), shape(Cylinder{0.1f, 1.3f}));
  return course;
}

}  // namespace samples
