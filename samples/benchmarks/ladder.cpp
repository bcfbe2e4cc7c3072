#include "samples/benchmarks/ladder.h"

#include "samples/shared/builders.h"

namespace samples::benchmarks {
namespace {

using namespace pfx;

constexpr int kSide = 20;

struct Effects {
  Geometry geometry = Sphere{0.5f};
  float height = 0.5f;  // m, of the centres
  float spin = 0.0f;    // rad/s
  float friction = 0.0f, restitution = 0.0f;
  MotionType motion_type = MotionType::Active;
  bool floor = true;
};

void addFloor(World& world, float friction, float restitution) {
  world.addBody({.name = "floor",
                 .pose = {.position = Vec3(0, -1, 0)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {shape(Box{Vec3(60, 1, 60)})},
                 .restitution = restitution,
                 .friction = friction});
}

Vec3 place(int i, float height) {
  return {2.0f * static_cast<float>(i % kSide - kSide / 2), height, 2.0f * static_cast<float>(i / kSide - kSide / 2)};
}

void addBodies(World& world, const Effects& e) {
  static_assert(kSide * kSide == kLadderBodies);
  if (e.floor) addFloor(world, e.friction, e.restitution);
  for (int i = 0; i < kLadderBodies; ++i)
    world.addBody({.pose = {.position = place(i, e.height)},
                   .angular_velocity = e.spin * Vec3(1.0f, 0.3f, 0.2f),
                   .motion_type = e.motion_type,
                   .shapes = {shape(e.geometry)},
                   .restitution = e.restitution,
                   .friction = e.friction});
}

const Geometry kBox = Box{Vec3(0.5f, 0.5f, 0.5f)}, kBrick = Box{Vec3(0.5f, 0.3f, 0.2f)};

void addPendulums(World& world) {
  for (int i = 0; i < kLadderBodies; ++i) {
    const Vec3 at = place(i, 5.0f);
    const BodyId hook = world.addBody({.pose = {.position = at},
                                       .motion_type = MotionType::Fixed,
                                       .shapes = {shape(Sphere{0.05f})},
                                       .filter_self = 0});
    const BodyId bob = world.addBody({.pose = {.position = at + Vec3(0.8f, 0, 0)},
                                      .shapes = {shape(kBrick)},
                                      .filter_self = 0});
    world.addJoint({.body_a = hook, .body_b = bob, .params = BallJointParams{.anchor_point = at}});
  }
}

void addSpheresOnMesh(World& world) {
  world.addBody({.name = "mesh",
                 .motion_type = MotionType::Fixed,
                 .shapes = {shape(world.keep(makeTerrain({.cells = 80, .half_extent = 40, .height = 0, .bowl = 0})))}});
  addBodies(world, {.friction = 0.6f, .floor = false});
}

}  // namespace

std::span<const Rung> ladder() {
  const static WorldDef weightless = {.gravity = Vec3::Zero()};
  static const Rung rungs[] = {
      {"nothing", [](World&) {}},
      {"fixed boxes", [](World& w) { addBodies(w, {.geometry = kBox, .motion_type = MotionType::Fixed, .floor = false}); }},
      {"free spheres", [](World& w) { addBodies(w, {.floor = false}); }, weightless, 60, 30.0},
      {"falling spheres", [](World& w) { addBodies(w, {.floor = false}); }, {}, 10, 30.0},
      {"spinning boxes", [](World& w) { addBodies(w, {.geometry = kBrick, .spin = 5.0f, .floor = false}); }, weightless, 60, 130.0},
      {"spheres on a floor, no friction", [](World& w) { addBodies(w, {}); }, {}, 60, 250.0},
      {"  and friction", [](World& w) { addBodies(w, {.friction = 0.6f}); }},
      {"  bouncing", [](World& w) { addBodies(w, {.height = 3.0f, .friction = 0.6f, .restitution = 0.9f}); }},
      {"  on a mesh", addSpheresOnMesh},
      {"boxes on a floor", [](World& w) { addBodies(w, {.geometry = kBox, .friction = 0.6f}); }},
      {"boxes asleep on a floor", [](World& w) { addBodies(w, {.geometry = kBox, .friction = 0.6f}); },
       {.sleeping = true, .sleep_steps = 30}, 120},
      {"pendulums", addPendulums},
  };
  return rungs;
}

}  // namespace samples::benchmarks
