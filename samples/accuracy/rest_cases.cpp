// ACC-19 to ACC-21: piles that start in their exact state of rest, so that every motion is an error.
#include "pfx/base_level/math/trig.h"
#include "samples/accuracy/case.h"
#include "samples/accuracy/rotation.h"

namespace samples::accuracy {
namespace {

using namespace pfx;

constexpr float kFriction = 0.6f;

void addFloor(World& world) {
  world.addBody({.name = "floor",
                 .pose = {.position = {0.0f, -1.0f, 0.0f}},
                 .motion_type = MotionType::Fixed,
                 .shapes = {{.geometry = Box{{20.0f, 1.0f, 20.0f}}}},
                 .restitution = 0.0f,
                 .friction = kFriction});
}

// Judged by the largest distance of a body from its start.
struct RestRun : Run {
  std::vector<TransformDouble> start;  // by body

  void advance(double) override {}
  std::vector<Truth> truth() const override {
    std::vector<Truth> all;
    for (size_t i = 1; i < start.size(); ++i) all.push_back({uint32_t(i), start[i]});
    return all;
  }
  double error(std::span<const BodyMotion> bodies) const override {
    double worst = 0.0;
    for (size_t i = 1; i < start.size(); ++i)
      worst = std::max(worst, (bodies[i].pose.position - start[i].position).norm());
    return worst;
  }
  void remember(const World& world) {
    for (const RigidState& s : world.states()) start.push_back(toDouble(s.pose()));
  }
};

// Boxes of 1 m and 1 kg on top of each other, the topmost one with another mass.
struct Stack final : RestRun {
  Stack(int boxes_in, float top_mass_in) : boxes(boxes_in), top_mass(top_mass_in) {}
  const int boxes;
  const float top_mass;

  void build(World& world) override {
    addFloor(world);
    for (int i = 0; i < boxes; ++i)
      world.addBody({.name = "box " + std::to_string(i),
                     .pose = {.position = Vec3(0, float(i) + 0.5f, 0)},
                     .shapes = {{.geometry = Box{Vec3::Constant(0.5f)}}},
                     .mass = i == boxes - 1 ? top_mass : 1.0f,
                     .restitution = 0.0f,
                     .friction = kFriction});
    remember(world);
  }
};

// Two cylinders on the floor that touch, and a third one on both. All contact forces follow from statics: half a
// weight and 0.134 of it for friction above, one and a half weights below.
struct Cylinders final : RestRun {
  void build(World& world) override {
    constexpr float kRadius = 0.5f;
    addFloor(world);
    const Quat along_z = turn(Vec3d(0, -0.5 * kPiDouble, 0)).cast<float>();
    const Vec3 places[] = {{-kRadius, kRadius, 0}, {kRadius, kRadius, 0}, {0, kRadius * (1.0f + std::sqrt(3.0f)), 0}};
    for (const Vec3& at : places)
      world.addBody({.name = "cylinder",
                     .pose = {at, along_z},
                     .shapes = {{.geometry = Cylinder{0.5f, kRadius}}},
                     .restitution = 0.0f,
                     .friction = kFriction});
    remember(world);
  }
};

}  // namespace

std::vector<Case> restCases() {
  return {
      {.id = "ACC-19",
       .name = "stack",
       .shows = "ten boxes on top of each other, started touching, for five seconds",
       .metric = "shift",
       .unit = "m",
       .target = 1e-3,
       .floor = 1e-5,
       .seconds = 5,
       .smooth = true,
       .make = [] { return std::unique_ptr<Run>(std::make_unique<Stack>(10, 1.0f)); }},
      {.id = "ACC-20",
       .name = "heavy_on_light",
       .shows = "four boxes of 1 kg carry one of a ton for five seconds",
       .metric = "shift",
       .unit = "m",
       .target = 1e-2,
       .floor = 1e-5,
       .seconds = 5,
       .smooth = true,
       .make = [] { return std::unique_ptr<Run>(std::make_unique<Stack>(5, 1000.0f)); },
       .front_page = true},
      {.id = "ACC-21",
       .name = "three_cylinders",
       .shows = "a cylinder rests on two that only friction keeps together",
       .metric = "shift",
       .unit = "m",
       .target = 1e-3,
       .floor = 1e-5,
       .seconds = 5,
       .smooth = true,
       .make = [] { return std::unique_ptr<Run>(std::make_unique<Cylinders>()); },
       .front_page = true},
  };
}

}  // namespace samples::accuracy
