#include "pfx/high_level/character/character_motion.h"

#include <algorithm>

namespace pfx {
namespace {

constexpr int kMaxSlides = 5;
// m/s, away from a surface that the capsule slides along, so that rounding does not make it an obstacle
// again.
constexpr float kAway = 1e-3f;
constexpr float kOnGround = 1e-3f;  // m, a gap that is left as it is

Vec3 horizontal(const Vec3& v) { return Vec3(v.x(), 0.0f, v.z()); }

Vec3 awayFrom(const Vec3& v, const Vec3& normal) { return v + (kAway - v.dot(normal)) * normal; }

class Planner {
 public:
  Planner(const CharacterProbe& probe, const CharacterParams& params, const Vec3& wanted, float dt)
      : probe_(probe), params_(params), direction_(horizontal(wanted)), dt_(dt) {
    if (!direction_.isZero(0.0f)) direction_.normalize();
  }

  GroundMotion plan(Vec3 v) {
    const Vec3 start = probe_.center();
    Vec3 at = start;
    float left = 1.0f;  // of the step
    for (int i = 0; i < kMaxSlides && left > 0.0f && v.squaredNorm() > kAway * kAway; ++i) {
      const Vec3 motion = left * dt_ * v;
      const ShapeCastOutput hit = probe_.cast(at, motion, kRigidObstacles);
      const float share = hit.hit ? hit.fraction : 1.0f;
      at += share * motion;
      left *= 1.0f - share;
      if (!hit.hit || hit.normal.isZero(0.0f)) break;
      v = deflected(at, v, hit);
    }
    return {(at - start) / dt_, climbs_};
  }

 private:
  Vec3 deflected(const Vec3& at, const Vec3& v, const ShapeCastOutput& hit) {
    const Vec3& n = hit.normal;
    if (probe_.canWalkOn(n)) return alongGround(v, n) + kAway * n;
    if (n.y() > -0.1f && direction_.dot(n) < 0.0f && probe_.findStep(at, hit, direction_)) {
      climbs_ = true;
      return overEdge(v, n);
    }
    const Vec3 wall = horizontal(n);
    if (wall.squaredNorm() < 1e-6f) return awayFrom(v, n);  // a ceiling
    return awayFrom(v, wall.normalized());
  }

  // Up and over the edge of a step, along the round end of the capsule.
  Vec3 overEdge(const Vec3& v, const Vec3& n) const {
    const Vec3 forward = std::max(v.norm(), params_.sneak_speed) * direction_;
    Vec3 along = forward - forward.dot(n) * n;
    along = along.squaredNorm() > 1e-6f && along.y() > 0.0f ? along.normalized() : Vec3(Vec3::UnitY());
    return std::min(forward.norm(), params_.climb_speed) * along + kAway * n;
  }

  const CharacterProbe& probe_;
  const CharacterParams& params_;
  Vec3 direction_;  // unit, horizontal, or zero
  float dt_;
  bool climbs_ = false;
};

}  // namespace

Vec3 clampedTo(const Vec3& v, float limit) {
  const float length = v.norm();
  return length > limit ? Vec3(limit / length * v) : v;
}

Vec3 alongGround(const Vec3& v, const Vec3& normal) {
  const Vec3 flat = horizontal(v);
  const float speed = v.norm();
  const Vec3 along(flat.x(), -flat.dot(horizontal(normal)) / normal.y(), flat.z());
  const float length = along.norm();
  return length > 0.0f ? Vec3(speed / length * along) : Vec3(Vec3::Zero());
}

GroundMotion planGroundMotion(const CharacterProbe& probe, const CharacterParams& params, const Vec3& wanted,
                              const Vec3& ground, float dt) {
  GroundMotion motion = Planner(probe, params, wanted, dt).plan(wanted);
  // Ground that falls away is followed; what leads up, a slope or a low edge, carries by itself.
  const bool rises = motion.climbs || motion.velocity.y() > wanted.y() + 2.0f * kAway;
  if (!rises) {
    const CharacterSupport next =
        probe.findSupport(probe.center() + dt * motion.velocity, params.step_height);
    if (next.body != kNoBody && probe.canWalkOn(next.normal) && next.gap > kOnGround)
      motion.velocity.y() -= std::min((next.gap - kOnGround) / dt, params.climb_speed);
  }
  motion.velocity += ground;
  return motion;
}

}  // namespace pfx
