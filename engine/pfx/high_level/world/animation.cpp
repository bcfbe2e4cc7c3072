#include "pfx/high_level/world/animation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/rigid_body/rotation_update.h"

namespace pfx {
namespace {

// Velocity at a key: that of the parabola through it and its neighbours; zero at the ends.
Vec3 tangentAt(const AnimationClip& clip, size_t i) {
  if (i == 0 || i + 1 == clip.keys.size()) return Vec3::Zero();
  const AnimationKey &a = clip.keys[i - 1], &b = clip.keys[i], &c = clip.keys[i + 1];
  const float before = b.time - a.time, after = c.time - b.time;
  const Vec3 v_before = (b.pose.position - a.pose.position) / before, v_after = (c.pose.position - b.pose.position) / after;
  return (after * v_before + before * v_after) / (before + after);
}

Quat slerp(const Quat& from, const Quat& to, float share) {
  Quat turn = to * from.conjugate();
  if (turn.w() < 0.0f) turn.coeffs() = -turn.coeffs();
  const float sine = turn.vec().norm();
  if (sine == 0.0f) return from;
  const Vec3 whole = 2.0f * atan2(sine, turn.w()) / sine * turn.vec();
  return (expMap(share * whole) * from).normalized();
}

Transform between(const AnimationClip& clip, size_t i, float time) {
  const AnimationKey &a = clip.keys[i], &b = clip.keys[i + 1];
  const float length = b.time - a.time, u = (time - a.time) / length;
  const float u2 = u * u, u3 = u2 * u;
  const Vec3 position = (2.0f * u3 - 3.0f * u2 + 1.0f) * a.pose.position + (3.0f * u2 - 2.0f * u3) * b.pose.position +
                        (u3 - 2.0f * u2 + u) * length * tangentAt(clip, i) + (u3 - u2) * length * tangentAt(clip, i + 1);
  return {position, slerp(a.pose.orientation, b.pose.orientation, u)};
}

}  // namespace

Transform sample(const AnimationClip& clip, float time) {
  float at = std::max(time, 0.0f);
  if (clip.loops && clip.duration() > 0.0f) at -= clip.duration() * std::floor(at / clip.duration());
  at += clip.keys.front().time;
  const auto next = std::upper_bound(clip.keys.begin(), clip.keys.end(), at,
                                     [](float t, const AnimationKey& k) { return t < k.time; });
  if (next == clip.keys.end()) return clip.keys.back().pose;
  if (next == clip.keys.begin()) return clip.keys.front().pose;
  return between(clip, static_cast<size_t>(next - clip.keys.begin()) - 1, at);
}

void AnimationPlayer::add(BodyId body, const AnimationClip& clip, float start) {
  if (clip.keys.empty()) throw std::invalid_argument("animation: the clip has no keys");
  for (size_t i = 0; i < clip.keys.size(); ++i) {
    const AnimationKey& k = clip.keys[i];
    const std::string place = "animation: key " + std::to_string(i);
    if (!k.pose.position.allFinite() || !(std::abs(k.pose.orientation.norm() - 1.0f) < 1e-3f))
      throw std::invalid_argument(place + ": the pose is not finite, or not a rotation");
    if (!std::isfinite(k.time) || (i > 0 && !(k.time > clip.keys[i - 1].time)))
      throw std::invalid_argument(place + ": the times do not ascend");
  }
  tracks_.push_back({body, &clip, start});
}

void AnimationPlayer::advance(World& world, float dt) {
  time_ += static_cast<double>(dt);
  std::erase_if(tracks_, [&](const Track& t) { return !world.isValid(t.body); });
  for (const Track& t : tracks_) world.moveKeyframe(t.body, sample(*t.clip, t.start + time()), dt);
}

}  // namespace pfx
