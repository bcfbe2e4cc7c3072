#include "samples/10_character_ctrl/actor.h"

#include <algorithm>

#include "pfx/base_level/math/trig.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;
using S = CharacterState;

constexpr float kStrideLength = 1.3f;  // m, of two steps

// Draws in the frame of the feet: x to the left, y up, z ahead.
class Painter {
 public:
  Painter(const Actor& actor, const World& world, Canvas& canvas)
      : actor_(actor), c_(actor.character), canvas_(canvas) {
    frame_ = {feetOf(c_, world), rotation(Vec3::UnitY(), c_.heading)};
  }

  void paint() const {
    const float h = c_.height(), r = c_.params.radius;
    const Quat upright = rotation(Vec3::UnitZ(), 0.5f * kPi);
    put(Capsule{0.5f * h - r, 1.012f * r}, {Vec3(0.0f, 0.5f * h, 0.0f), upright}, actor_.outfit.coat,
        Finish::Soft);
    put(Cylinder{0.045f, 1.03f * r}, {Vec3(0.0f, 0.46f * h, 0.0f), upright}, actor_.outfit.trim,
        Finish::Matte);
    put(Capsule{0.45f * r, 0.32f * r}, {Vec3(0.0f, h - 0.95f * r, 0.78f * r), Quat::Identity()}, 0xff1f2a33u,
        Finish::Glossy);
    for (const float side : {-1.0f, 1.0f}) limbs(side);
    if (actor_.labelled) canvas_.label(frame_.apply(Vec3(0.0f, h + 0.35f, 0.0f)), toString(c_.state));
  }

 private:
  void limbs(float side) const {
    const float h = c_.height(), r = c_.params.radius;
    const SinCos swing = sincos(actor_.gait.stride + (side > 0.0f ? 0.0f : kPi));
    const bool airborne = !isGrounded(c_.state);
    const float reach = airborne ? 0.25f : c_.state == S::Run ? 1.15f : 0.9f;
    const Vec3 shoe(side * 0.5f * r,
                    airborne ? -0.12f * r : 0.26f * r + 0.35f * r * std::max(0.0f, swing.cos),
                    reach * r * swing.sin + 0.25f * r);
    put(Capsule{0.3f * r, 0.27f * r}, {shoe, rotation(Vec3::UnitY(), -0.5f * kPi)}, actor_.outfit.trim,
        Finish::Matte);
    Vec3 hand(side * 1.28f * r, 0.47f * h, -0.9f * r * swing.sin);
    if (c_.state == S::Push) hand = Vec3(side * 0.7f * r, 0.62f * h, 1.25f * r);
    if (airborne) hand = Vec3(side * 1.5f * r, 0.75f * h, 0.2f * r);
    put(Sphere{0.27f * r}, {hand, Quat::Identity()}, 0xffe8c39eu, Finish::Soft);
  }

  void put(const Geometry& geometry, const Transform& pose, Color color, Finish finish) const {
    canvas_.solid(geometry, frame_ * pose, {color, finish});
  }

  const Actor& actor_;
  const Character& c_;
  Canvas& canvas_;
  Transform frame_;
};

}  // namespace

void Gait::advance(const Character& character, const World& world, float dt) {
  Vec3 v = world.states()[character.body.index].linear_velocity - character.ground_velocity;
  v.y() = 0.0f;
  const float speed = isGrounded(character.state) ? v.norm() : 0.0f;
  if (speed < 0.05f) {
    stride = 0.0f;
  } else {
    stride += 2.0f * kPi * speed * dt / kStrideLength;
  }
}

void drawActor(const Actor& actor, const World& world, Canvas& canvas) {
  Painter(actor, world, canvas).paint();
}

}  // namespace samples
