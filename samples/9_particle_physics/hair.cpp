// Hair: strands that grow from a head which is shaken.
#include <algorithm>
#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "pfx/high_level/particles/particle_builder.h"
#include "samples/9_particle_physics/particle_scene.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

constexpr int kStrands = 260, kPoints = 15;
constexpr float kHeadRadius = 0.5f, kLength = 1.15f;  // m
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
    for (int i = 0; i < kStrands; ++i) grow(def, i);
    add(world, std::move(def));
  }

  void draw(const World& world, Canvas& canvas) const override {
    constexpr Color kShades[3] = {0xff7a4a24u, 0xff8f5a2eu, 0xff69401fu};
    const ParticleSystem& p = particles(world);
    for (size_t i = 0; i < p.strands().size(); ++i)
      drawStrand(p, p.strands()[i], {.radius = 0.011f, .paint = {kShades[i % 3], Finish::Soft}}, canvas);
  }

  std::vector<Reading> readings(const World& world) const override {
    std::vector<Reading> out = ParticleScene::readings(world);
    float root_error = 0.0f;
    const ParticleSystem& p = particles(world);
    for (const ParticleAnchor& a : p.anchors())
      root_error =
          std::max(root_error, (p.positions()[a.particle] - world.states()[a.body].pose().apply(a.local)).norm());
    out.insert(out.begin(), {"distance of roots from the head", "m", root_error});
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
  // Roots lie on a spiral over the crown; strands stand off the head at first and fall with the first steps.
  void grow(ParticleDef& def, int i) const {
    constexpr float kGoldenAngle = 2.39996323f;
    const float share = (static_cast<float>(i) + 0.5f) / kStrands;
    const float up = 1.0f - 1.05f * share, across = std::sqrt(1.0f - up * up);
    const SinCos turn = sincos(kGoldenAngle * static_cast<float>(i));
    const Vec3 out(across * turn.cos, up, across * turn.sin);
    const bool is_face = out.z() > 0.25f && up < 0.62f;
    if (is_face) return;
    const auto first = static_cast<uint32_t>(def.positions.size());
    const float length = kLength * (1.0f - 0.25f * share), link = length / (kPoints - 1);
    Vec3 at = kHeadRadius * out, direction = (out + Vec3(0, 0.15f, 0)).normalized();
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
    def.anchors.push_back({.particle = first, .body = head_.index, .local = kHeadRadius * out});
  }

  BodyId head_;
  float time_ = 0.0f, angle_ = 0.0f;
};

}  // namespace

std::unique_ptr<Scene> makeHair() { return std::make_unique<Hair>(); }

}  // namespace samples
