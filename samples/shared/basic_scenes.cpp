#include "samples/shared/basic_scenes.h"

#include "samples/all_in_world.h"
#include "samples/shared/builders.h"
#include "samples/shared/drift.h"

namespace samples {

using namespace pfx;

void addPrimitives(World& world) {
  constexpr float kLawn = 4.0f;  // 1/s, of what rolls, to a halt
  world.addBody({.name = "sphere",
                 .pose = {.position = Vec3(-5.0f, 5.0f, 0.0f)},
                 .shapes = {shape(Sphere{1.0f})},
                 .angular_damping = kLawn});
  addBody(world, "box", Box{Vec3::Ones()}, Vec3(0.0f, 5.0f, 5.0f), 1.0f);
  world.addBody({.name = "capsule",
                 .pose = {.position = Vec3(5.0f, 5.0f, 0.0f)},
                 .shapes = {shape(Capsule{1.5f, 0.5f})},
                 .mass = 2.0f,
                 .angular_damping = kLawn});
  addBody(world, "cylinder", Cylinder{0.5f, 1.5f}, Vec3(0.0f, 10.0f, 0.0f), 3.0f);
  addBody(world, "barrel", world.keep(makeBarrel()), Vec3(0.0f, 15.0f, 0.0f), 3.0f);
  world.addBody({.name = "compound",
                 .pose = {.position = Vec3(0.0f, 5.0f, 0.0f)},
                 .shapes = {shape(Box{Vec3(0.5f, 0.5f, 1.5f)}, {.position = Vec3(-2.0f, 0.0f, 0.0f)}),
                            shape(Box{Vec3(0.5f, 1.5f, 0.5f)}, {.position = Vec3(2.0f, 0.0f, 0.0f)}),
                            shape(Capsule{1.5f, 0.5f})},
                 .mass = 3.0f,
                 .angular_damping = 1.0f});
}

void addLandscape(World& world) {
  const Quat tilt = rotation(Vec3::UnitX(), 0.06f) * rotation(Vec3::UnitY(), 0.7f);
  world.addBody({.name = "landscape",
                 .pose = {.position = Vec3(0.0f, -2.0f, 0.0f), .orientation = tilt},
                 .motion_type = MotionType::Fixed,
                 .shapes = {shape(world.keep(makeTerrain({})))}});
}

namespace {

struct Primitives final : Scene, AllInWorld {
  void build(World& world) override {
    addGround(world);
    addPrimitives(world);
  }
};

struct Landscape final : Scene, AllInWorld {
  void build(World& world) override {
    addLandscape(world);
    addPrimitives(world);
  }
};

// Boxes hung one below the other; the lowest one is given a push, and air drags at it.
struct Joints final : Scene, AllInWorld {
  void build(World& world) override {
    constexpr int kBoxes = 10;
    const BodyId ground = addGround(world);
    BodyId below = {};
    for (int i = 0; i < kBoxes; ++i) {
      const float y = 3.0f + 2.5f * static_cast<float>(i);
      BodyDef def{.name = "box " + std::to_string(i), .pose = {.position = Vec3(0.0f, y, 0.0f)}};
      def.shapes = {shape(Box{Vec3::Ones()})};
      if (i == 0) {
        def.linear_velocity = Vec3(0.0f, 0.0f, 5.0f);
        def.linear_damping = def.angular_damping = 3.1f;  // 5 % in each step
      }
      const BodyId box = world.addBody(def);
      if (below) join(world, box, below, y - 1.25f);
      below = box;
    }
    join(world, ground, below, 3.0f + 2.5f * static_cast<float>(kBoxes) - 1.25f);
  }

  static void join(World& world, BodyId upper, BodyId lower, float y) {
    world.addJoint({.body_a = upper,
                    .body_b = lower,
                    .params = SwingTwistJointParams{.anchor_point = Vec3(0.0f, y, 0.0f),
                                                    .twist_axis = Vec3::UnitY(),
                                                    .damping = 0.1f}});
  }
};

// A stack says how far it has come from where it was built.
struct Stack : Scene, AllInWorld {
  void draw(const World& world, Canvas& canvas) const override {
    const Vec3 above = top_ + Vec3(0.0f, 1.6f, 0.0f);
    canvas.label(above, "drift " + millimetres(drift_.largest(world)));
  }
  std::vector<Color> bodyColors(const World& world) const override {
    if (world.def().sleeping) return {};  // there colours tell who sleeps
    return driftColors(world, drift_);
  }
  std::vector<Reading> readings(const World& world) const override {
    return {{"largest drift of a box", "mm", 1e3 * static_cast<double>(drift_.largest(world))}};
  }

 protected:
  void watch(const World& world) {
    drift_ = Drift(world);
    top_ = Vec3(0.0f, world.states().back().position.y(), 0.0f);
  }

 private:
  Drift drift_;
  Vec3 top_ = Vec3::Zero();
};

struct Tower final : Stack {
  void build(World& world) override {
    addGround(world);
    addTower(world, {});
    watch(world);
  }
};

struct Pyramid final : Stack {
  void build(World& world) override {
    addGround(world);
    addPyramid(world, {});
    watch(world);
  }
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

std::vector<SceneEntry> basicScenes(std::string_view sample, const WorldDef& world) {
  return {
      {.sample = sample,
       .name = "primitives",
       .shows = "each kind of shape falls, rolls or tips, and comes to rest",
       .camera = {.target = Vec3(0.0f, 5.0f, 1.0f), .distance = 28.0f, .yaw_deg = 28.0f, .pitch_deg = 18.0f},
       .frames = {50, 110, 360},
       .world = world,
       .make = make<Primitives>},
      {.sample = sample,
       .name = "joints",
       .shows = "ten boxes hang from the ground body and swing; no joint stretches",
       .camera = {.target = Vec3(0.0f, 15.0f, 0.0f), .distance = 46.0f, .yaw_deg = 60.0f, .pitch_deg = 8.0f},
       .frames = {0, 60, 240},
       .world = world,
       .make = make<Joints>},
      {.sample = sample,
       .name = "tower",
       .shows = "192 boxes in eight rings carry each other; they redden as they drift (red: 0.6 m)",
       .camera = {.target = Vec3(0.0f, 6.5f, 0.0f), .distance = 42.0f, .yaw_deg = 25.0f, .pitch_deg = 26.0f},
       .frames = {0, 120, 600},
       .world = world,
       .make = make<Tower>},
      {.sample = sample,
       .name = "pyramid",
       .shows = "the lowest row carries 190 boxes; they redden as they drift (red: 0.6 m)",
       .camera = {.target = Vec3(0.0f, 10.0f, 0.0f), .distance = 40.0f, .yaw_deg = 32.0f, .pitch_deg = 12.0f},
       .frames = {0, 120, 600},
       .world = world,
       .make = make<Pyramid>},
      {.sample = sample,
       .name = "landscape",
       .shows = "the same shapes on a mesh of 128 triangles: they follow its slopes and never catch on an "
                "inner edge",
       .camera = {.target = Vec3(0.0f, 0.8f, 0.0f), .distance = 27.0f, .yaw_deg = 28.0f, .pitch_deg = 24.0f},
       .frames = {45, 100, 400},
       .world = world,
       .make = make<Landscape>},
  };
}

}  // namespace samples
