// Sample 5_raycast: nearest hits on every shape, on a mesh, by filter, and inside an area alone.
#include "pfx/base_level/math/trig.h"
#include "pfx/low_level/broadphase/proxy.h"
#include "pfx/low_level/broadphase/tree_broadphase.h"
#include "samples/5_raycast/ray_set.h"
#include "samples/registry.h"
#include "samples/shared/basic_scenes.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

float stepAngle(const World& world, float per_step) { return per_step * static_cast<float>(world.stepCount()); }

// 100 rays from a ring that slowly turns. All of them end below the ground, so that none may come through.
struct RingScene : Scene {
  static constexpr float kTurnPerStep = 0.004f;   // rad
  static constexpr double kSurfaceLimit = 1e-3;   // m

  static RaySet rays(const World& world) {
    return castAt(world, ringOfRays({.angle = stepAngle(world, kTurnPerStep)}));
  }

  void draw(const World& world, Canvas& canvas) const override { samples::draw(rays(world), world, canvas); }

  std::vector<Reading> readings(const World& world) const override {
    const RaySet set = rays(world);
    return {{"rays that hit", "of 100", static_cast<double>(set.numHits())},
            {"farthest hit from its surface", "m", farthestFromSurface(set, world), kSurfaceLimit}};
  }
};

struct Primitives final : RingScene {
  void build(World& world) override {
    addGround(world);
    addPrimitives(world);
  }
};

struct Landscape final : RingScene {
  void build(World& world) override {
    addLandscape(world);
    addPrimitives(world);
  }
};

// Four plates over each other, and five rays that each see one of them, or none. Every second the rays swap filters.
struct Filter final : Scene {
  static constexpr int kPlates = 4, kRays = 5;
  static constexpr uint64_t kStepsPerSwap = 60;

  void build(World& world) override {
    for (int i = 0; i < kPlates; ++i)
      world.addBody({.name = "plate " + std::to_string(1 << i),
                     .pose = {.position = Vec3(0.0f, 2.0f + 2.0f * static_cast<float>(i), 0.0f)},
                     .motion_type = MotionType::Fixed,
                     .shapes = {shape(Box{Vec3(5.0f, 0.25f, 5.0f)})},
                     .filter_self = 1u << i});
  }

  // Which filter a ray has now: 0 .. 3 is that of a plate, 4 that of none.
  static int filterOf(const World& world, int ray) {
    return static_cast<int>((static_cast<uint64_t>(ray) + world.stepCount() / kStepsPerSwap) % kRays);
  }

  static RaySet rays(const World& world) {
    std::vector<RayInput> rays;
    for (int i = 0; i < kRays; ++i)
      rays.push_back({.start = Vec3(static_cast<float>(i) - 2.0f, 10.0f, 0.0f),
                      .direction = Vec3(0.0f, -10.0f, 2.0f),
                      .filter_target = 1u << filterOf(world, i)});
    return castAt(world, std::move(rays));
  }

  void draw(const World& world, Canvas& canvas) const override {
    const RaySet set = rays(world);
    samples::draw(set, world, canvas);
    for (const RayInput& ray : set.rays)
      canvas.label(ray.start + Vec3(0.0f, 0.5f, 0.0f), std::to_string(ray.filter_target));
    for (int i = 0; i < kPlates; ++i)
      canvas.label(world.states()[static_cast<size_t>(i)].position + Vec3(5.2f, 0.0f, 5.0f), std::to_string(1 << i));
  }

  std::vector<Reading> readings(const World& world) const override {
    const RaySet set = rays(world);
    double wrong = 0.0;
    for (int i = 0; i < kRays; ++i) {
      const RayOutput& hit = set.hits[static_cast<size_t>(i)];
      const int filter = filterOf(world, i);
      wrong += filter == kPlates ? hit.hit : !hit.hit || hit.body != static_cast<uint32_t>(filter);
    }
    return {{"rays that hit", "of 5", static_cast<double>(set.numHits())}, {"wrong plates", "", wrong, 0.5}};
  }
};

// A box circles over a ring of falling boxes. Rays all around the ring see only bodies that the box meets: for the rays
// of a step, proxies are made of these alone.
struct Area final : Scene {
  static constexpr int kLayers = 5, kColumns = 36;
  static constexpr float kRadius = 15.0f, kHalfExtent = 5.0f;  // m
  static constexpr float kTurnPerStep = 0.02f;                 // rad
  static constexpr uint32_t kGroundFilter = 2u, kBoxFilter = 1u;

  void build(World& world) override {
    const BodyId ground = addGround(world);
    world.state(ground).filter_self = kGroundFilter;
    for (int layer = 0; layer < kLayers; ++layer)
      for (int i = 0; i < kColumns; ++i) {
        const float turns = (static_cast<float>(i) + 0.5f * static_cast<float>(layer % 2)) / static_cast<float>(kColumns);
        const float angle = 2.0f * kPi * turns;
        world.addBody({.name = "box",
                       .pose = {.position = Vec3(kRadius * cos(angle), 2.0f + 2.6f * static_cast<float>(layer), kRadius * sin(angle)),
                                .orientation = rotation(Vec3::UnitY(), -angle)},
                       .shapes = {shape(Box{Vec3::Ones()})},
                       .filter_self = kBoxFilter});
      }
  }

  static WorldBox area(const World& world) {
    const float angle = stepAngle(world, kTurnPerStep);
    return {Vec3(kRadius * cos(angle), kHalfExtent, kRadius * sin(angle)), Vec3::Constant(kHalfExtent)};
  }

  static RaySet rays(const World& world) {
    RaySet set;
    for (const float radius : {kRadius - 0.6f, kRadius + 0.6f}) {
      const auto ring = ringOfRays({.radius = radius, .height = 16.0f, .end_radius = radius, .depth = 0.0f});
      for (RayInput ray : ring) {
        ray.direction = Vec3(0.0f, -ray.start.y(), 0.0f);
        ray.filter_target = kBoxFilter;
        set.rays.push_back(ray);
      }
    }
    set.hits.resize(set.rays.size());

    std::vector<RigidState> states(world.states().begin(), world.states().end());
    std::vector<BroadphaseProxy> proxies(states.size());
    const auto made = updateProxies(states, world.collidables(),
                                    {.world = area(world), .out_of_world = OutOfWorld::RemoveProxy}, proxies);
    TreeBroadphase inside;
    inside.update(std::span(proxies).first(made.num_proxies));
    castRays(set.rays, {world.states(), world.collidables(), &inside}, set.hits);
    return set;
  }

  void draw(const World& world, Canvas& canvas) const override {
    samples::draw(rays(world), world, canvas);
    const WorldBox box = area(world);
    canvas.solid(Box{box.extent}, {.position = box.center}, {.color = 0x2858a0d0u});
    const Stroke edge{0xff2060a0u, 2.0f};
    for (int axis = 0; axis < 3; ++axis)
      for (const float u : {-1.0f, 1.0f})
        for (const float v : {-1.0f, 1.0f}) {
          Vec3 from = box.extent;
          from[(axis + 1) % 3] *= u;
          from[(axis + 2) % 3] *= v;
          Vec3 to = from;
          to[axis] = -to[axis];
          canvas.line(box.center + from, box.center + to, edge);
        }
  }

  std::vector<Reading> readings(const World& world) const override {
    const RaySet set = rays(world);
    double outside = 0.0;
    for (const RayOutput& hit : set.hits)
      outside += hit.hit && !area(world).meets(bodyAabb(world.states()[hit.body], world.collidables()[hit.body]));
    return {{"rays that hit", "of 200", static_cast<double>(set.numHits())}, {"hits outside the area", "", outside, 0.5}};
  }
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

std::vector<SceneEntry> raycastScenes() {
  const CameraPose ring = {.target = Vec3(0.0f, 2.5f, 0.0f), .distance = 33.0f, .yaw_deg = 28.0f, .pitch_deg = 30.0f};
  return {{.sample = "5_raycast",
           .name = "primitives",
           .shows = "100 rays find the nearest point of every kind of shape, with its normal",
           .camera = ring,
           .frames = {0, 60, 240},
           .world = {},
           .make = make<Primitives>},
          {.sample = "5_raycast",
           .name = "landscape",
           .shows = "the same rays on a mesh: they name the triangle that they hit, and none slips through",
           .camera = ring,
           .frames = {0, 60, 240},
           .world = {},
           .make = make<Landscape>},
          {.sample = "5_raycast",
           .name = "filter",
           .shows = "each ray hits the plate that its filter names, and passes through all others",
           .camera = {.target = Vec3(0.0f, 5.6f, 1.0f), .distance = 19.0f, .yaw_deg = 36.0f, .pitch_deg = 9.0f},
           .frames = {0, 60, 180},
           .world = {},
           .make = make<Filter>},
          {.sample = "5_raycast",
           .name = "area",
           .shows = "the rays see only bodies that the moving box meets",
           .camera = {.target = Vec3(0.0f, 4.5f, 0.0f), .distance = 51.0f, .yaw_deg = 25.0f, .pitch_deg = 32.0f},
           .frames = {0, 60, 157},
           .world = {},
           .make = make<Area>}};
}

}  // namespace samples
