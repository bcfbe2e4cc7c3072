#include "pfx/high_level/character/character_probe.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/math/trig.h"

namespace pfx {
namespace {

// m, as a share of the radius: the capsule that looks down is thinner, to pass walls that the character
// touches.
constexpr float kThinner = 0.07f;
constexpr float kLift = 0.02f;  // m, it starts that much higher, so as to see how deep the feet are in
constexpr float kFeelerRadius = 0.005f;   // m, of the ball that feels for a surface
constexpr float kInward = 0.02f;          // m, from an edge onto the surface behind it
constexpr float kStepTolerance = 0.005f;  // m
constexpr float kFoothold = 0.05f;        // m, that must be free above a step

// Capsules lie along x.
Quat upright() {
  const float half = 0.70710678f;
  return Quat(half, 0.0f, 0.0f, half);
}

Geometry capsuleOf(float height, float radius) { return Capsule{0.5f * height - radius, radius}; }

// The horizontal direction from the character towards what it met.
Vec3 inwardOf(const Vec3& normal, const Vec3& direction) {
  Vec3 inward(-normal.x(), 0.0f, -normal.z());
  if (inward.squaredNorm() < 1e-6f) inward = Vec3(direction.x(), 0.0f, direction.z());
  const float length = inward.norm();
  return length > 0.0f ? Vec3(inward / length) : Vec3(Vec3::Zero());
}

}  // namespace

CharacterProbe::CharacterProbe(const World& world, const Character& character)
    : world_(world),
      params_(character.params),
      state_(world.states()[character.body.index]),
      body_(character.body.index),
      height_(character.height()),
      center_(state_.position),
      min_normal_y_(cos(character.params.max_slope)) {}

ShapeCastOutput CharacterProbe::castGeometry(const Geometry& geometry, const Vec3& start, const Vec3& motion,
                                             uint8_t types) const {
  return world_.castShape({.geometry = geometry,
                           .start = {start, upright()},
                           .motion = motion,
                           .filter_self = state_.filter_self,
                           .filter_target = state_.filter_target,
                           .ignore_body = body_,
                           .motion_types = types});
}

ShapeCastOutput CharacterProbe::cast(const Vec3& start, const Vec3& motion, uint8_t types) const {
  return castGeometry(capsuleOf(height_, params_.radius), start, motion, types);
}

std::optional<CharacterProbe::Surface> CharacterProbe::surfaceBelow(const Vec3& start, float depth,
                                                                    uint8_t types) const {
  const ShapeCastOutput hit = castGeometry(Sphere{kFeelerRadius}, start, Vec3(0.0f, -depth, 0.0f), types);
  if (!hit.hit || hit.overlaps) return std::nullopt;
  return Surface{hit.point, hit.normal};
}

CharacterSupport CharacterProbe::findSupport(const Vec3& center, float reach) const {
  const Vec3 start = center + Vec3(0.0f, kLift, 0.0f);
  const float thinner = kThinner * params_.radius, depth = kLift + reach + 2.0f * thinner;
  const Geometry core = Capsule{0.5f * height_ - params_.radius, params_.radius - thinner};
  const ShapeCastOutput hit = castGeometry(core, start, Vec3(0.0f, -depth, 0.0f), kAllObstacles);
  if (!hit.hit || hit.normal.isZero(0.0f)) return {};
  CharacterSupport support{
      .body = hit.body,
      // The whole capsule touches a slope sooner than the thin one, by its part of the radius.
      .gap = hit.fraction * depth - kLift - thinner / std::max(hit.normal.y(), 0.5f),
      .point = hit.point,
      .contact_normal = hit.normal,
      .normal = hit.normal};
  // On an edge the contact slants; the surface behind the edge says whether one can stand there.
  if (!canWalkOn(hit.normal)) {
    const Vec3 above = hit.point + kInward * inwardOf(hit.normal, Vec3::Zero()) + Vec3(0.0f, 0.05f, 0.0f);
    const auto surface = surfaceBelow(above, 0.1f, kAllObstacles);
    if (surface && surface->normal.y() > hit.normal.y()) support.normal = surface->normal;
  }
  return support;
}

std::optional<StepUp> CharacterProbe::findStep(const Vec3& center, const ShapeCastOutput& hit,
                                               const Vec3& direction) const {
  const float feet = center.y() - 0.5f * height_, highest = params_.step_height + kStepTolerance;
  const Vec3 inward = inwardOf(hit.normal, direction);
  Vec3 feeler = hit.point + kInward * inward;
  feeler.y() = feet + highest + kFeelerRadius + kStepTolerance;
  const auto top = surfaceBelow(feeler, highest + kStepTolerance, kRigidObstacles);
  if (!top || !canWalkOn(top->normal)) return std::nullopt;
  const float rise = top->point.y() - feet;
  if (rise > highest) return std::nullopt;
  const Vec3 up(0.0f, std::max(rise, 0.0f) + kStepTolerance, 0.0f);
  if (cast(center, up, kRigidObstacles).hit) return std::nullopt;
  const ShapeCastOutput ahead = cast(center + up, kFoothold * inward, kRigidObstacles);
  if (ahead.hit && !canWalkOn(ahead.normal) && ahead.point.y() > feet + highest) return std::nullopt;
  return StepUp{rise};
}

bool CharacterProbe::hasHeadroom() const {
  const float missing = params_.height - height_;
  if (missing <= 0.0f) return true;
  return !cast(center_, Vec3(0.0f, missing, 0.0f), kAllObstacles).hit;
}

}  // namespace pfx
