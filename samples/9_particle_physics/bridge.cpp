// A rope bridge of particles that bodies roll over, and jelly that keeps its volume.
#include <algorithm>
#include <array>
#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "pfx/high_level/particles/particle_builder.h"
#include "samples/9_particle_physics/particle_scene.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

constexpr int kAlong = 41, kRopes = 7;           // particles along a rope; ropes of the deck
constexpr float kSpan = 8.0f, kWidth = 1.3f;     // m
constexpr float kHeight = 2.6f, kSag = 0.55f;    // m, of the ends; of the middle

// Ropes from bank to bank with cross ropes. Balls and a barrel roll across from the left bank, whose top is a slope.
class Bridge final : public ParticleScene {
 public:
  void build(World& world) override {
    addGround(world);
    for (const float side : {-1.0f, 1.0f}) {
      const Vec3 half(1.6f, 0.5f * kHeight, 1.5f);
      banks_[side < 0 ? 0 : 1] = world.addBody({.name = side < 0 ? "left bank" : "right bank",
                                                .pose = {.position = Vec3(side * (0.5f * kSpan + half.x()), half.y(), 0)},
                                                .motion_type = MotionType::Fixed,
                                                .shapes = {shape(Box{half})}});
    }
    const Vec3 start(-0.5f * kSpan - 1.0f, kHeight + 0.45f, 0.0f);
    addRoller(world, "ball", Sphere{0.42f}, start + Vec3(0, 0, 0.1f), 6.0f, 2.6f);
    addRoller(world, "barrel", Cylinder{0.5f, 0.4f}, start + Vec3(-1.15f, 0, 0), 9.0f, 2.4f);
    addRoller(world, "second ball", Sphere{0.35f}, start + Vec3(-1.9f, -0.05f, -0.15f), 4.0f, 1.8f);
    ParticleDef def{.name = "bridge"};
    def.settings.radius = 0.06f;
    weave(def);
    add(world, std::move(def));
  }

  void draw(const World& world, Canvas& canvas) const override {
    const ParticleSystem& p = particles(world);
    for (const ParticleStrand& s : p.strands()) {
      const bool is_rope = s.particles.size() == kAlong;
      drawStrand(p, s, {.radius = is_rope ? 0.035f : 0.05f, .paint = {0xff9a6b3cu, Finish::Soft}, .strain = is_rope},
                 canvas);
    }
  }

 private:
  static void addRoller(World& world, const char* name, const Geometry& geometry, const Vec3& at, float mass,
                        float speed) {
    const Quat turn = std::holds_alternative<Cylinder>(geometry) ? rotation(Vec3::UnitY(), 0.5f * kPi) : Quat(Quat::Identity());
    world.addBody({.name = name,
                   .pose = {.position = at, .orientation = turn},
                   .linear_velocity = Vec3(speed, 0, 0),
                   .angular_velocity = Vec3(0, 0, -speed / 0.4f),
                   .shapes = {shape(geometry)},
                   .mass = mass});
  }

  // The curve of the deck hangs between the edges of the banks; edges are higher than the middle, so that bodies stay.
  void weave(ParticleDef& def) const {
    const auto at = [](int rope, int k) { return static_cast<uint32_t>(rope * kAlong + k); };
    for (int rope = 0; rope < kRopes; ++rope)
      for (int k = 0; k < kAlong; ++k) {
        const float s = 2.0f * static_cast<float>(k) / (kAlong - 1) - 1.0f;
        const float w = 2.0f * static_cast<float>(rope) / (kRopes - 1) - 1.0f;
        def.positions.push_back(Vec3(0.5f * kSpan * s, kHeight - 0.07f - kSag * (1.0f - s * s) + 0.45f * w * w * w * w * (1.0f - s * s),
                                     0.5f * kWidth * w));
        def.masses.push_back(0.12f);
      }
    for (int rope = 0; rope < kRopes; ++rope) {
      ParticleStrand strand;
      for (int k = 0; k < kAlong; ++k) strand.particles.push_back(at(rope, k));
      def.strands.push_back(std::move(strand));
      for (const int end : {0, 1}) {
        const uint32_t i = at(rope, end * (kAlong - 1));
        const uint32_t bank = banks_[static_cast<size_t>(end)].index;
        const Vec3 center((end == 0 ? -1.0f : 1.0f) * (0.5f * kSpan + 1.6f), 0.5f * kHeight, 0);
        def.anchors.push_back({.particle = i, .body = bank, .local = def.positions[i] - center});
      }
    }
    for (int k = 1; k + 1 < kAlong; ++k) {
      ParticleStrand slat;
      for (int rope = 0; rope < kRopes; ++rope) slat.particles.push_back(at(rope, k));
      addBending(def, slat.particles, 60.0f);
      def.strands.push_back(std::move(slat));
    }
    for (int rope = 0; rope + 1 < kRopes; ++rope)
      for (int k = 0; k + 1 < kAlong; ++k)
        def.distances.push_back({.a = at(rope, k), .b = at(rope + 1, k + 1), .compliance = 2e-4f});
  }

  std::array<BodyId, 2> banks_;
};

// Cubes and balls of tetrahedra under a plank.
class Jelly final : public ParticleScene {
 public:
  Jelly() { strain_limit_ = 0.0, damping_ = 0.4f, friction_ = 0.8f; }

  void build(World& world) override {
    addGround(world);
    world.addBody({.name = "step",
                   .pose = {.position = Vec3(-1.6f, 0.2f, 0)},
                   .motion_type = MotionType::Fixed,
                   .shapes = {shape(Box{Vec3(0.5f, 0.2f, 1.2f)})}});
    world.addBody({.name = "weight",
                   .pose = {.position = Vec3(1.1f, 3.4f, 0)},
                   .shapes = {shape(Box{Vec3(0.45f, 0.25f, 0.45f)})},
                   .mass = 12.0f});
    ParticleDef def{.name = "jelly"};
    def.settings.radius = 0.03f;
    const auto toBall = [](const Vec3& p) {
      const float reach = p.cwiseAbs().maxCoeff(), length = p.norm();
      return length > 0.0f ? Vec3(reach / length * p) : p;
    };
    SoftBoxShape cube{.center = Vec3(1.1f, 1.0f, 0), .half_extent = Vec3::Constant(0.6f), .cells = {6, 6, 6}, .mass = 30.0f,
                      .edge_compliance = 4e-4f};
    cubes_[0] = addSoftBox(def, cube);
    cube.center = Vec3(-1.3f, 1.9f, 0.1f), cube.shape = toBall, cube.edge_compliance = 8e-4f;
    cubes_[1] = addSoftBox(def, cube);
    add(world, std::move(def));
  }

  void draw(const World& world, Canvas& canvas) const override {
    constexpr Color kColors[2] = {0xff4fa37au, 0xffc9566bu};
    for (size_t i = 0; i < cubes_.size(); ++i)
      canvas.surface({.points = particles(world).positions(), .indices = cubes_[i].triangles},
                     {kColors[i], Finish::Glossy});
  }

  std::vector<Reading> readings(const World& world) const override {
    return {{"volume, of that at rest", "%", 100.0 * particles(world).relativeVolume()},
            {"particles", "", static_cast<double>(particles(world).positions().size())}};
  }

 private:
  std::array<SoftBox, 2> cubes_;
};

}  // namespace

std::unique_ptr<Scene> makeBridge() { return std::make_unique<Bridge>(); }
std::unique_ptr<Scene> makeJelly() { return std::make_unique<Jelly>(); }

}  // namespace samples
