// Hair: strands that grow from a head which is shaken.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "pfx/base_level/math/trig.h"
#include "pfx/high_level/particles/particle_builder.h"
#include "samples/9_particle_physics/particle_scene.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

constexpr int kStrands = 260, kPoints = 15;
constexpr float kHeadRadius = 0.5f, kLength = 1.05f;  // m
constexpr float kTop = 2.1f;                        // m, height of the head

// The strands keep a slight curl, since the angle between their links is held.
class Hair final : public ParticleScene {
 public:
  Hair() { damping_ = 1.0f, friction_ = 0.2f; }

  void build(World& world) override {
    addGround(world);
    head_ = world.addBody({.name = "head",
                           .pose = {.position = Vec3(0, kTop, 0)},
                           .motion_type = MotionType::Keyframe,
                           .shapes = {shape(Sphere{kHeadRadius}),
                                      shape(Capsule{0.25f, 0.17f}, {Vec3(0, -0.6f, 0), rotation(Vec3::UnitZ(), 0.5f * kPi)}),
                                      shape(Capsule{0.45f, 0.22f}, {Vec3(0, -1.0f, 0), Quat::Identity()})}});
    ParticleDef def{.name = "hair"};
    def.settings.radius = 0.015f;
    std::vector<int> strand_of(kStrands, -1);  // by place on the spiral
    for (int i = 0; i < kStrands; ++i)
      if (grow(def, i)) strand_of[static_cast<size_t>(i)] = static_cast<int>(def.strands.size()) - 1;
    findNeighbours(strand_of);
    add(world, std::move(def));
  }

  void draw(const World& world, Canvas& canvas) const override {
    drawHead(world.states()[head_.index].pose(), canvas);
    constexpr Color kShades[3] = {0xff6b4322u, 0xff7d5029u, 0xff58361bu};
    const ParticleSystem& p = particles(world);
    for (size_t i = 0; i < p.strands().size(); ++i)
      drawStrand(p, p.strands()[i], {.radius = 0.007f, .tip = 0.4f, .paint = {kShades[i % 3], Finish::Soft}}, canvas);
    std::array<Vec3, kPoints> between;
    for (const auto& [a, b] : neighbours_) {
      const auto &from = p.strands()[a].particles, &to = p.strands()[b].particles;
      for (const float share : {0.33f, 0.67f}) {
        for (size_t k = 0; k < kPoints; ++k)
          between[k] = (1.0f - share) * p.positions()[from[k]] + share * p.positions()[to[k]];
        drawRods(between, {.radius = 0.007f, .tip = 0.4f, .paint = {kShades[(a + b) % 3], Finish::Soft}}, canvas);
      }
    }
  }

  std::vector<Reading> readings(const World& world) const override {
    std::vector<Reading> out = ParticleScene::readings(world);
    float root_error = 0.0f;
    const ParticleSystem& p = particles(world);
    for (const ParticleAnchor& a : p.anchors())
      root_error =
          std::max(root_error, (p.positions()[a.particle] - world.states()[a.body].pose().apply(a.local)).norm());
    out.insert(out.begin(), {"distance of roots from the head", "m", root_error, 1e-9});
    return out;
  }

 protected:
  // Shakes for three seconds, nods once, then holds still.
  void script(World& world, float dt) override {
    time_ += dt;
    const float shake = time_ < 3.0f ? 0.9f * sin(6.0f * time_) * std::min(1.0f, time_) : 0.0f;
    const float nod = time_ > 3.0f && time_ < 4.2f ? 0.5f * (1.0f - cos(2.0f * kPi * (time_ - 3.0f) / 1.2f)) : 0.0f;
    angle_ += 0.35f * (shake - angle_);
    world.moveKeyframe(head_,
                       {Vec3(0, kTop, 0), rotation(Vec3::UnitY(), angle_) * rotation(Vec3::UnitX(), 0.45f * nod)}, dt);
  }

 private:
  static bool isFace(const Vec3& out) { return out.z() > 0.25f && out.y() < 0.62f; }

  // Where no strand is simulated, two are drawn between those beside it. On a spiral by the golden angle, places whose
  // numbers differ by these of Fibonacci lie side by side.
  void findNeighbours(std::span<const int> strand_of) {
    for (const size_t apart : {size_t(8), size_t(13), size_t(21)})
      for (size_t i = 0; i + apart < strand_of.size(); ++i)
        if (strand_of[i] >= 0 && strand_of[i + apart] >= 0)
          neighbours_.push_back({static_cast<size_t>(strand_of[i]), static_cast<size_t>(strand_of[i + apart])});
  }

  // A face, so that one sees where the head looks, and a scalp.
  static void drawHead(const Transform& head, Canvas& canvas) {
    constexpr Paint kSkin{0xffd9a98au, Finish::Soft}, kShirt{0xff44617au, Finish::Matte}, kDark{0xff2b2724u, Finish::Glossy},
        kScalp{0xff58361bu, Finish::Matte};
    constexpr float kCoat = 0.004f;  // m, over the body's own shapes
    const auto part = [&](const Geometry& geometry, const Vec3& at, const Paint& paint, const Quat& turn = Quat::Identity()) {
      canvas.solid(geometry, head * Transform{at, turn}, paint);
    };
    part(Sphere{kHeadRadius + kCoat}, Vec3::Zero(), kSkin);
    part(Capsule{0.25f, 0.17f + kCoat}, Vec3(0, -0.6f, 0), kSkin, rotation(Vec3::UnitZ(), 0.5f * kPi));
    part(Capsule{0.45f, 0.22f + kCoat}, Vec3(0, -1.0f, 0), kShirt);
    part(Sphere{0.07f}, kHeadRadius * Vec3(0, -0.08f, 1.0f), kSkin);
    for (const float side : {-1.0f, 1.0f}) {
      part(Sphere{0.055f}, kHeadRadius * Vec3(0.36f * side, 0.14f, 0.9f), kDark);
      part(Sphere{0.09f}, kHeadRadius * Vec3(0.98f * side, -0.05f, 0.0f), kSkin);
    }
    part(Capsule{0.08f, 0.02f}, kHeadRadius * Vec3(0, -0.42f, 0.9f), kDark);
    part(Sphere{0.984f * kHeadRadius}, kHeadRadius * Vec3(0, 0.028f, -0.034f), kScalp);
  }

  // Roots lie on a spiral over the crown; strands stand off the head at first and fall with the first steps. Returns
  // whether there is one, which there is not on the face.
  bool grow(ParticleDef& def, int i) const {
    constexpr float kGoldenAngle = 2.39996323f;
    const float share = (static_cast<float>(i) + 0.5f) / kStrands;
    const float up = 1.0f - 1.05f * share, across = std::sqrt(1.0f - up * up);
    const SinCos turn = sincos(kGoldenAngle * static_cast<float>(i));
    const Vec3 out(across * turn.cos, up, across * turn.sin);
    if (isFace(out)) return false;
    const auto first = static_cast<uint32_t>(def.positions.size());
    const float length = kLength * (1.0f - 0.25f * share), link = length / (kPoints - 1);
    // Combed back and to the sides: the second particle is held as well.
    const Vec3 back(1.1f * out.x(), 0.0f, -0.9f);
    Vec3 at = kHeadRadius * out, direction = (0.45f * out + back - back.dot(out) * out).normalized();
    ParticleStrand strand;
    for (int k = 0; k < kPoints; ++k) {
      def.positions.push_back(Vec3(0, kTop, 0) + at);
      def.masses.push_back(2e-4f);
      strand.particles.push_back(first + static_cast<uint32_t>(k));
      direction = (direction + Vec3(0, -0.26f, 0)).normalized();
      at += link * direction;
      if (at.norm() < kHeadRadius + 0.03f) at *= (kHeadRadius + 0.03f) / at.norm();
    }
    addBending(def, strand.particles, 3e-6f);
    def.strands.push_back(std::move(strand));
    for (const uint32_t held : {first, first + 1})
      def.anchors.push_back({.particle = held, .body = head_.index, .local = def.positions[held] - Vec3(0, kTop, 0)});
    return true;
  }

  BodyId head_;
  std::vector<std::pair<size_t, size_t>> neighbours_;  // strands
  float time_ = 0.0f, angle_ = 0.0f;
};

}  // namespace

std::unique_ptr<Scene> makeHair() { return std::make_unique<Hair>(); }

}  // namespace samples
