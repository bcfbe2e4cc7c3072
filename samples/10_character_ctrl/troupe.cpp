#include "samples/10_character_ctrl/troupe.h"

#include <algorithm>
#include <bit>

#include "pfx/base_level/math/trig.h"

namespace samples {

using namespace pfx;

size_t Troupe::add(World& world, const CharacterDef& def, const Outfit& outfit) {
  characters_.push_back(addCharacter(world, def));
  inputs_.emplace_back();
  outfits_.push_back(outfit);
  gaits_.emplace_back();
  return characters_.size() - 1;
}

void Troupe::beforeStep(World& world, float dt) {
  updateCharacters(world, characters_, inputs_, dt);
  for (const Character& c : characters_) reached_ |= 1u << static_cast<uint32_t>(c.state);
}

void Troupe::afterStep(const World& world, float dt) {
  for (size_t i = 0; i < characters_.size(); ++i) gaits_[i].advance(characters_[i], world, dt);
  for (size_t a = 0; a < characters_.size(); ++a)
    for (size_t b = a + 1; b < characters_.size(); ++b) {
      const Vec3 fa = feetOf(characters_[a], world), fb = feetOf(characters_[b], world);
      if (std::abs(fa.y() - fb.y()) > 1.0f) continue;
      const float radii = characters_[a].params.radius + characters_[b].params.radius;
      overlap_ = std::max(overlap_, radii - Vec3(fa.x() - fb.x(), 0.0f, fa.z() - fb.z()).norm());
    }
}

void Troupe::draw(const World& world, Canvas& canvas, bool labelled) const {
  for (size_t i = 0; i < characters_.size(); ++i)
    drawActor({characters_[i], gaits_[i], outfits_[i], labelled}, world, canvas);
}

int Troupe::statesReached() const { return std::popcount(reached_); }

CharacterInput inputOf(const Controls& controls) {
  const SinCos yaw = sincos(controls.heading);
  const Vec3 forward(-yaw.sin, 0.0f, -yaw.cos), right(yaw.cos, 0.0f, -yaw.sin);
  return {.direction = controls.forward * forward + controls.right * right,
          .run = controls.run,
          .jump = controls.jump,
          .crouch = controls.crouch};
}

Vec3 directionTo(const Vec3& from, const Vec3& to) {
  constexpr float kSlowDown = 0.25f;  // m
  const Vec3 way(to.x() - from.x(), 0.0f, to.z() - from.z());
  const float distance = way.norm();
  return distance > kSlowDown ? Vec3(way / distance) : Vec3(way / kSlowDown);
}

}  // namespace samples
