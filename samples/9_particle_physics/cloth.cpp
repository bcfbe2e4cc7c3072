// Cloth: a curtain that a ball swings into, and a sheet that falls over bodies.
#include <array>
#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "pfx/high_level/particles/particle_builder.h"
#include "samples/9_particle_physics/particle_scene.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

constexpr int kSide = 32;  // particles along each edge

// Hangs from a rail in nine rings, with folds; the ball hangs on a cord and swings through it to and fro.
class Curtain final : public ParticleScene {
 public:
  Curtain() { iterations_ = 4.0f; }

  void build(World& world) override {
    addGround(world);
    const Vec3 ball_at(0.4f, 2.6f, 2.9f), hook_at(0.4f, 6.0f, 0.3f), ends(1.75f, 3.6f, 0.0f);
    const BodyId rail = world.addBody({.name = "rail",
                                       .pose = {.position = Vec3(0, ends.y(), 0)},
                                       .motion_type = MotionType::Fixed,
                                       .shapes = {shape(Cylinder{ends.x() + 0.15f, 0.035f})},
                                       .filter_self = 2});
    const BodyId ball = world.addBody({.name = "ball",
                                       .pose = {.position = ball_at},
                                       .linear_velocity = Vec3(0, 0, -1.5f),
                                       .shapes = {shape(Sphere{0.38f})},
                                       .mass = 2.0f,
                                       .friction = 0.4f});
    const BodyId hook = world.addBody({.name = "hook",
                                       .pose = {.position = hook_at},
                                       .motion_type = MotionType::Fixed,
                                       .shapes = {shape(Box{Vec3::Constant(0.06f)})}});
    world.addJoint({.name = "cord",
                    .body_a = hook,
                    .body_b = ball,
                    .params = DistanceJointParams{.anchor_point_a = hook_at,
                                                  .anchor_point_b = ball_at}});
    ParticleDef def{.name = "curtain"};
    def.settings.radius = 0.03f;
    def.settings.filter_target = 1;
    addCloth(def, {.corner = Vec3(-ends.x(), ends.y() - 0.05f, 0),
                   .along = Vec3(2.0f * ends.x(), 0, 0),
                   .across = Vec3(0, -2.9f, 0),
                   .columns = kSide,
                   .rows = kSide,
                   .mass = 1.2f,
                   .shear_compliance = 5e-3f,
                   .bending_stiffness = 2e-5f});
    measureLengths(def);
    fold(def);
    for (int ring = 0; ring <= 8; ++ring) {
      const auto i = static_cast<uint32_t>(ring * (kSide - 1) / 8);
      def.anchors.push_back({.particle = i, .body = rail.index, .local = def.positions[i] - Vec3(0, ends.y(), 0)});
    }
    add(world, std::move(def));
  }

  void draw(const World& world, Canvas& canvas) const override {
    drawSheet(particles(world), {.columns = kSide, .rows = kSide, .paint = {0xffd9c08cu, Finish::Soft}, .check = 0xffa98a4eu}, canvas);
    canvas.line(world.states()[3].position, world.states()[2].position, {0xff404852u, 2.0f});
  }

 private:
  // As long as they are before the sheet is folded.
  static void measureLengths(ParticleDef& def) {
    for (ParticleStrand& s : def.strands) {
      s.lengths.clear();
      for (size_t k = 0; k + 1 < s.particles.size(); ++k)
        s.lengths.push_back((def.positions[s.particles[k]] - def.positions[s.particles[k + 1]]).norm());
    }
    for (DistanceConstraint& c : def.distances) c.length = (def.positions[c.a] - def.positions[c.b]).norm();
  }

  // Waves that make it a tenth narrower and stretch no thread: where a link goes back or forth, it goes less far along.
  static void fold(ParticleDef& def) {
    constexpr float kDepth = 0.08f;  // m
    const auto out = [](int column) { return kDepth * cos(8.0f * kPi * static_cast<float>(column) / (kSide - 1)); };
    std::array<float, kSide> x{};
    for (int k = 1; k < kSide; ++k) {
      const float link = def.positions[static_cast<size_t>(k)].x() - def.positions[static_cast<size_t>(k - 1)].x();
      const float forth = out(k) - out(k - 1);
      x[static_cast<size_t>(k)] = x[static_cast<size_t>(k - 1)] + std::sqrt(link * link - forth * forth);
    }
    for (size_t i = 0; i < def.positions.size(); ++i) {
      Vec3& p = def.positions[i];
      p.x() = x[i % kSide] - 0.5f * x.back();
      p.z() += out(static_cast<int>(i % kSide));
    }
  }
};

// Falls over a ball, a box and a capsule that stand on the ground and may be pushed.
class Drape final : public ParticleScene {
 public:
  Drape() { damping_ = 0.8f, iterations_ = 4.0f; }

  void build(World& world) override {
    addGround(world);
    world.addBody({.name = "ball",
                   .pose = {.position = Vec3(-0.75f, 0.7f, 0.1f)},
                   .motion_type = MotionType::Fixed,
                   .shapes = {shape(Sphere{0.7f})}});
    world.addBody({.name = "box",
                   .pose = {.position = Vec3(0.85f, 0.5f, 0.5f), .orientation = rotation(Vec3::UnitY(), 0.5f)},
                   .shapes = {shape(Box{Vec3(0.45f, 0.5f, 0.45f)})},
                   .mass = 20.0f});
    world.addBody({.name = "roll",
                   .pose = {.position = Vec3(0.6f, 0.25f, -0.75f), .orientation = rotation(Vec3::UnitY(), 0.3f)},
                   .shapes = {shape(Capsule{0.5f, 0.25f})},
                   .mass = 8.0f,
                   .angular_damping = 1.0f});
    ParticleDef def{.name = "sheet"};
    def.settings.radius = 0.045f;  // as far as a corner may come out between particles
    addCloth(def, {.corner = Vec3(-1.8f, 1.9f, -2.0f),
                   .along = Vec3(3.9f, 0, 0.3f),
                   .across = Vec3(-0.3f, 0, 3.9f),
                   .columns = kSide,
                   .rows = kSide,
                   .mass = 1.5f,
                   .shear_compliance = 2e-2f,
                   .bending_stiffness = 1e-4f});
    add(world, std::move(def));
  }

  void draw(const World& world, Canvas& canvas) const override {
    drawSheet(particles(world), {.columns = kSide, .rows = kSide, .paint = {0xffc2566au, Finish::Soft}, .check = 0xffe6b8b4u}, canvas);
  }
};

}  // namespace

std::unique_ptr<Scene> makeCurtain() { return std::make_unique<Curtain>(); }
std::unique_ptr<Scene> makeDrape() { return std::make_unique<Drape>(); }

}  // namespace samples
