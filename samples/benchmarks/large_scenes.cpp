// Scenes of thousands of bodies: gravity 10 m/s^2, friction 0.6, no bounce.
#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/shape/convex_hull.h"
#include "samples/benchmarks/scenes.h"
#include "samples/shared/builders.h"

namespace samples::benchmarks {
namespace {

using namespace pfx;

constexpr float kFriction = 0.6f;

void addFloor(World& world, float half_side) {
  world.addBody({.name = "floor",
                 .pose = {.position = {0.0f, -1.0f, 0.0f}},
                 .motion_type = MotionType::Fixed,
                 .shapes = {shape(Box{{half_side, 1.0f, half_side}})},
                 .restitution = 0.0f,
                 .friction = kFriction});
}

void addCube(World& world, const Vec3& position, float half, float density) {
  world.addBody({.name = "box",
                 .pose = {.position = position},
                 .shapes = {shape(Box{Vec3::Constant(half)})},
                 .mass = density * 8.0f * half * half * half,
                 .restitution = 0.0f,
                 .friction = kFriction});
}

// Triangle of unit cubes that touch on all sides; `corner`: centre of the first cube of the lowest row.
void addTriangle(World& world, const Vec3& corner, int base) {
  for (int row = 0; row < base; ++row)
    for (int i = 0; i < base - row; ++i)
      addCube(world, corner + Vec3(0.5f * static_cast<float>(row) + static_cast<float>(i), static_cast<float>(row), 0.0f),
              0.5f, 100.0f);
}

struct LargePyramid final : Scene {
  void build(World& world) override {
    addFloor(world, 400.0f);
    addTriangle(world, {-49.5f, 0.5f, 0.0f}, 100);
  }
};

struct ManyPyramids final : Scene {
  void build(World& world) override {
    constexpr int kSide = 14, kBase = 10;
    constexpr float kHalf = 77.0f;
    addFloor(world, kHalf);
    for (int i = 0; i < kSide; ++i)
      for (int k = 0; k < kSide; ++k)
        addTriangle(world,
                    {-kHalf + 11.0f * static_cast<float>(k) + 0.5f, 0.5f,
                     -kHalf + 1.0f + 2.0f * (kHalf - 1.0f) / (kSide - 1) * static_cast<float>(i)},
                    kBase);
  }
};

// A net of balls, each held by a ball joint at the one above and at the one on its left. Nothing collides.
struct JointGrid final : Scene {
  static constexpr int kSide = 100;

  void build(World& world) override {
    std::vector<BodyId> balls;
    for (int k = 0; k < kSide; ++k)
      for (int i = 0; i < kSide; ++i) {
        const Vec3 at(static_cast<float>(k), -static_cast<float>(i), 0.0f);
        balls.push_back(world.addBody({.name = "ball",
                                       .pose = {.position = at},
                                       .motion_type = i == 0 ? MotionType::Fixed : MotionType::Active,
                                       .shapes = {shape(Sphere{0.4f})},
                                       .mass = 1000.0f * 4.18879f * 0.064f,
                                       .filter_self = 2,
                                       .filter_target = ~2u}));
        const auto self = balls.size() - 1;
        if (i > 0) join(world, balls[self - 1], balls[self], at + Vec3(0.0f, 0.5f, 0.0f));
        if (k > 0) join(world, balls[self - kSide], balls[self], at - Vec3(0.5f, 0.0f, 0.0f));
      }
  }
  static void join(World& world, BodyId a, BodyId b, const Vec3& at) {
    if (world.states()[a.index].motion_type == MotionType::Fixed &&
        world.states()[b.index].motion_type == MotionType::Fixed)
      return;
    world.addJoint({.body_a = a, .body_b = b, .params = BallJointParams{.anchor_point = at}});
  }
};

// 8000 small cubes in a drum that turns by 25 degrees a second.
struct Washer final : Scene {
  BodyId drum;
  double time = 0.0;  // s

  void build(World& world) override {
    addFloor(world, 60.0f);
    std::vector<Shape> parts;
    constexpr float kStep = kPi / 18.0f, kWider = kPi / 180.0f;  // rad
    for (int i = 0; i < 36; ++i) {
      const float angle = kStep * static_cast<float>(i);
      parts.push_back(shape(world.keep(wedge({16.0f, 18.0f}, {angle - kWider, angle + kStep + kWider}))));
      if (i % 9 == 0) parts.push_back(shape(world.keep(wedge({14.0f, 16.0f}, {angle, angle + kStep}))));
    }
    drum = world.addBody({.name = "drum",
                          .pose = place(),
                          .motion_type = MotionType::Keyframe,
                          .shapes = parts,
                          .restitution = 0.0f,
                          .friction = kFriction});
    for (int i = 0; i < 8000; ++i) {
      const Vec3 cell(static_cast<float>(i % 20), static_cast<float>(i / 20 % 20), static_cast<float>(i / 400));
      addCube(world, Vec3(-8.0f, 13.0f, -8.0f) + 0.8f * cell, 0.2f, 1000.0f);
    }
  }
  void beforeStep(World& world, float dt) override {
    time += double(dt);
    world.moveKeyframe(drum, place(), dt);
  }

  Transform place() const {
    return {.position = Vec3(0.0f, 21.0f, 0.0f),
            .orientation = rotation(Vec3::UnitZ(), static_cast<float>(time) * 25.0f * kPi / 180.0f)};
  }

  struct Range {
    float from, to;
  };
  static ConvexMesh wedge(Range radius, Range angle) {
    std::vector<Vec3> points;
    for (const float a : {angle.from, angle.to}) {
      const SinCos turn = sincos(a);
      for (const float r : {radius.from, radius.to})
        for (const float z : {-10.0f, 10.0f}) points.emplace_back(r * turn.cos, r * turn.sin, z);
    }
    ConvexMesh mesh;
    if (buildConvexMesh(points, mesh) != Error::Ok) throw std::logic_error("the drum's wall is not a convex mesh");
    return mesh;
  }
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

std::vector<Case> largeCases() {
  const WorldDef world = {.gravity = Vec3(0.0f, -10.0f, 0.0f)};
  return {
      {.name = "large_pyramid",
       .shows = "5,050 boxes in 100 rows: one island, and it stands",
       .make = make<LargePyramid>,
       .steps = 200,
       .starts_at_rest = true,
       .large = true,
       .world = world,
       .camera = {.target = {0.0f, 42.0f, 0.0f}, .distance = 190.0f, .yaw_deg = 26.0f, .pitch_deg = 8.0f},
       .frames = {20}},
      {.name = "many_pyramids",
       .shows = "196 pyramids of 55 boxes: as many islands",
       .make = make<ManyPyramids>,
       .steps = 100,
       .starts_at_rest = true,
       .large = true,
       .world = world,
       .camera = {.target = {0.0f, 0.0f, 0.0f}, .distance = 165.0f, .yaw_deg = 35.0f, .pitch_deg = 30.0f},
       .frames = {10}},
      {.name = "joint_grid",
       .shows = "10,000 balls in a net of 19,701 joints, hung up by its upper edge",
       .make = make<JointGrid>,
       .steps = 100,
       .starts_at_rest = false,
       .large = true,
       .world = world,
       .camera = {.target = {49.5f, -52.0f, 0.0f}, .distance = 175.0f, .yaw_deg = 18.0f, .pitch_deg = 6.0f},
       .frames = {20}},
      {.name = "washer",
       .shows = "8,000 cubes in a drum that turns",
       .make = make<Washer>,
       .steps = 1000,
       .starts_at_rest = false,
       .large = true,
       .world = world,
       .camera = {.target = {0.0f, 20.5f, 0.0f}, .distance = 62.0f, .yaw_deg = 16.0f, .pitch_deg = 8.0f},
       .frames = {60}},
  };
}

}  // namespace samples::benchmarks
