// A rope bridge of particles with planks that bodies roll over, and jelly that keeps its volume.
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
constexpr float kRail = 0.8f;                    // m, of the hand ropes above the deck
constexpr int kHanger = 2;                       // links from one hanger to the next

// Ropes from bank to bank carry planks, and hand ropes on posts carry the deck's edges. Balls and a barrel roll across from
// the left bank.
class Bridge final : public ParticleScene {
 public:
  void build(World& world) override {
    addGround(world);
    for (const float side : {-1.0f, 1.0f}) banks_[side < 0 ? 0 : 1] = addBank(world, side);
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
    for (const ParticleStrand& s : p.strands())
      if (s.particles.size() == kAlong) drawStrand(p, s, {.radius = 0.03f, .strain = true}, canvas);
    for (const float side : {0.0f, 1.0f})
      for (int k = 0; k < kAlong; k += kHanger) {
        const std::array<Vec3, 2> hanger = {p.positions()[at(side == 0.0f ? 0 : kRopes - 1, k)],
                                            p.positions()[at(kRopes + static_cast<int>(side), k)]};
        drawRods(hanger, {.radius = 0.018f, .paint = {0xff8a7350u, Finish::Matte}}, canvas);
      }
    drawPlanks(p, canvas);
  }

 private:
  static uint32_t at(int rope, int k) { return static_cast<uint32_t>(rope * kAlong + k); }

  static Vec3 bankCenter(float side) { return {side * (0.5f * kSpan + 1.6f), 0.5f * kHeight, 0}; }

  // A block with two posts at its edge, which the hand ropes end at.
  static BodyId addBank(World& world, float side) {
    const Vec3 half(1.6f, 0.5f * kHeight, 1.5f);
    BodyDef bank{.name = side < 0 ? "left bank" : "right bank",
                 .pose = {.position = bankCenter(side)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {shape(Box{half})}};
    for (const float z : {-1.0f, 1.0f})
      bank.shapes.push_back(shape(Box{Vec3(0.08f, 0.5f * kRail + 0.1f, 0.08f)},
                                  {Vec3(-side * (half.x() - 0.08f), half.y() + 0.5f * kRail, 0.5f * z * kWidth + 0.1f * z)}));
    return world.addBody(bank);
  }

  static void addRoller(World& world, const char* name, const Geometry& geometry, const Vec3& from, float mass,
                        float speed) {
    const Quat turn = std::holds_alternative<Cylinder>(geometry) ? rotation(Vec3::UnitY(), 0.5f * kPi) : Quat(Quat::Identity());
    world.addBody({.name = name,
                   .pose = {.position = from, .orientation = turn},
                   .linear_velocity = Vec3(speed, 0, 0),
                   .angular_velocity = Vec3(0, 0, -speed / 0.4f),
                   .shapes = {shape(geometry)},
                   .mass = mass});
  }

  // A rope along x from bank to bank that sags by a parabola; `lift` is that of its middle, `up` of all of it.
  struct Line {
    float z, lift, up, mass;  // m, m, m, kg a particle
  };
  void addLine(ParticleDef& def, const Line& line) const {
    ParticleStrand strand;
    for (int k = 0; k < kAlong; ++k) {
      const float s = 2.0f * static_cast<float>(k) / (kAlong - 1) - 1.0f;
      strand.particles.push_back(static_cast<uint32_t>(def.positions.size()));
      def.positions.push_back(
          Vec3(0.5f * kSpan * s, kHeight - 0.07f + line.up - (kSag - line.lift) * (1.0f - s * s), line.z));
      def.masses.push_back(line.mass);
    }
    for (const size_t end : {0u, 1u}) {
      const uint32_t i = end == 0 ? strand.particles.front() : strand.particles.back();
      def.anchors.push_back({.particle = i,
                             .body = banks_[end].index,
                             .local = def.positions[i] - bankCenter(end == 0 ? -1.0f : 1.0f)});
    }
    def.strands.push_back(std::move(strand));
  }

  // The deck's edges are higher than its middle, so that bodies stay.
  void weave(ParticleDef& def) const {
    for (int rope = 0; rope < kRopes; ++rope) {
      const float w = 2.0f * static_cast<float>(rope) / (kRopes - 1) - 1.0f;
      addLine(def, {.z = 0.5f * kWidth * w, .lift = 0.3f * w * w * w * w, .up = 0.0f, .mass = 0.12f});
    }
    for (const float side : {-1.0f, 1.0f})
      addLine(def, {.z = side * (0.5f * kWidth + 0.1f), .lift = 0.3f, .up = kRail, .mass = 0.06f});
    for (int k = 1; k + 1 < kAlong; ++k) {
      ParticleStrand slat;
      for (int rope = 0; rope < kRopes; ++rope) slat.particles.push_back(at(rope, k));
      addBending(def, slat.particles, 60.0f);
      def.strands.push_back(std::move(slat));
    }
    for (int rope = 0; rope + 1 < kRopes; ++rope)
      for (int k = 0; k + 1 < kAlong; ++k)
        def.distances.push_back({.a = at(rope, k), .b = at(rope + 1, k + 1), .compliance = 2e-4f});
    for (int k = kHanger; k + 1 < kAlong; k += kHanger) {
      def.distances.push_back({.a = at(0, k), .b = at(kRopes, k), .compliance = 1e-5f});
      def.distances.push_back({.a = at(kRopes - 1, k), .b = at(kRopes + 1, k), .compliance = 1e-5f});
    }
  }

  // A plank lies across the ropes at each of their particles: boxes from rope to rope.
  static void drawPlanks(const ParticleSystem& p, Canvas& canvas) {
    constexpr Color kWood[3] = {0xff9a7142u, 0xff8a6238u, 0xffa67c4du};
    constexpr float kHalfWidth = 0.075f, kHalfThickness = 0.022f;
    for (int k = 1; k + 1 < kAlong; ++k)
      for (int rope = 0; rope + 1 < kRopes; ++rope) {
        const Vec3 &a = p.positions()[at(rope, k)], &b = p.positions()[at(rope + 1, k)];
        const Vec3 z = (b - a).normalized(), ahead = p.positions()[at(rope, k + 1)] - p.positions()[at(rope, k - 1)];
        Mat3 axes;
        axes.col(2) = z;
        axes.col(1) = z.cross(ahead).normalized();
        axes.col(0) = axes.col(1).cross(z);
        canvas.solid(Box{Vec3(kHalfWidth, kHalfThickness, 0.5f * (b - a).norm() + 0.002f)},
                     {0.5f * (a + b) + 0.02f * axes.col(1), Quat(axes)}, {kWood[k * 7 % 3], Finish::Matte});
      }
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
                      .edge_compliance = 1.2e-3f};
    cubes_[0] = addSoftBox(def, cube);
    cube.center = Vec3(-1.3f, 1.9f, 0.1f), cube.shape = toBall, cube.edge_compliance = 2e-3f;
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
