// Ranges of joints as fans and cones, and the loads that joints carry.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "viewer/inspect/body_facts.h"
#include "viewer/run/overlay_scene.h"

namespace viewer {
namespace {

using pfx::Vec3;

constexpr Color kRangeColor = 0xff4a9ad4, kNeedleColor = 0xffd9480f, kForceColor = 0xff2f6fb0,
                kTorqueColor = 0xff8a4fb0;
constexpr float kTau = 6.2831853f;

// A joint where it stands: the frame in the first body.
struct Placed {
  pfx::Transform frame;
  pfx::JointCoordinates at;
  float size;  // m
  uint32_t pick;
};

Vec3 onArc(const Placed& j, int about, float angle) {
  // Twist turns y about x; swing turns x about y and about z.
  const Vec3 axis = Vec3::Unit(about), from = Vec3::Unit(about == 0 ? 1 : 0);
  return j.frame.apply(j.size * (std::cos(angle) * from + std::sin(angle) * axis.cross(from)));
}

// A fan over the range of a rotation, and a needle where the joint stands.
void addFan(const OverlayScene& scene, const Placed& j, int axis, const pfx::AxisConstraint& c) {
  const float lower = std::max(c.lower, -kTau), upper = std::min(c.upper, kTau);
  const int spokes = std::max(2, int(std::ceil((upper - lower) / 0.26f)));  // 15 degrees
  Vec3 last = onArc(j, axis - 3, lower);
  for (int i = 0; i <= spokes; ++i) {
    const Vec3 next = onArc(j, axis - 3, lower + (upper - lower) * float(i) / float(spokes));
    scene.list.add(Line{j.frame.position, next, (kRangeColor & 0x00ffffffu) | 0x66000000u, 1.5f, j.pick});
    if (i > 0) scene.list.add(Line{last, next, kRangeColor, 2.0f, j.pick});
    last = next;
  }
  scene.list.add(
      Line{j.frame.position, onArc(j, axis - 3, float(j.at.value[axis])), kNeedleColor, 3.0f, j.pick});
}

// The cone that the x axis of the second body stays in.
void addCone(const OverlayScene& scene, const Placed& j, float angle, const Vec3& stands) {
  const float open = std::clamp(angle, 0.0f, 0.5f * kTau);
  Vec3 last = Vec3::Zero();
  constexpr int kSides = 24;
  for (int i = 0; i <= kSides; ++i) {
    const float turn = kTau * float(i) / float(kSides);
    const Vec3 next = j.frame.apply(
        j.size * Vec3(std::cos(open), std::sin(open) * std::cos(turn), std::sin(open) * std::sin(turn)));
    if (i > 0) scene.list.add(Line{last, next, kRangeColor, 2.0f, j.pick});
    if (i % 3 == 0) scene.list.add(Line{j.frame.position, next, (kRangeColor & 0x00ffffffu) | 0x66000000u, 1.5f, j.pick});
    last = next;
  }
  scene.list.add(Line{j.frame.position, j.frame.position + j.size * stands, kNeedleColor, 3.0f, j.pick});
}

void addLimits(const OverlayScene& scene, const pfx::Joint& joint, const Placed& j, const pfx::Transform& body_b) {
  using enum pfx::JointLock;
  for (int k = 0; k < 3; ++k)
    if (joint.axis[k].lock == Limit) {
      const auto at = [&](double x) { return j.frame.apply(float(x) * Vec3::Unit(k)); };
      scene.list.add(Line{at(joint.axis[k].lower), at(joint.axis[k].upper), kRangeColor, 4.0f, j.pick});
      scene.list.add(Point{at(j.at.value[k]), kNeedleColor, 10.0f, j.pick});
    }
  if (joint.axis[3].lock == Limit) addFan(scene, j, 3, joint.axis[3]);
  if (joint.cone && joint.axis[4].lock == Limit)
    addCone(scene, j, joint.axis[4].upper, body_b.orientation * joint.frame_b * Vec3::UnitX());
  else
    for (int k = 4; k < pfx::kNumJointAxes; ++k)
      if (joint.axis[k].lock == Limit) addFan(scene, j, k, joint.axis[k]);
}

void addLoads(const OverlayScene& scene) {
  const pfx::World& world = scene.world;
  float force = 0.0f, torque = 0.0f;
  for (uint32_t i = 0; i < world.jointLinks().size(); ++i)
    if (world.jointLinks()[i].exists) {
      force = std::max(force, world.joints()[i].force.norm());
      torque = std::max(torque, world.joints()[i].torque.norm());
    }
  for (uint32_t i = 0; i < world.jointLinks().size(); ++i) {
    const pfx::JointLink& link = world.jointLinks()[i];
    if (!link.exists || (!scene.shows(link.body_a) && !scene.shows(link.body_b))) continue;
    const pfx::Joint& joint = world.joints()[i];
    const Vec3 at = world.states()[link.body_b].pose().apply(joint.anchor_b);
    const uint32_t pick = pickId(PickKind::Joint, i);
    if (joint.force.norm() > 0.01f * force)
      scene.list.add(Arrow{at, at + scene.unit / force * joint.force, kForceColor, 2.5f, pick});
    if (joint.torque.norm() > 0.01f * torque)
      scene.list.add(Arrow{at, at + scene.unit / torque * joint.torque, kTorqueColor, 2.5f, pick});
  }
  char text[64];
  std::snprintf(text, sizeof text, "force, longest %.3g N", double(force));
  if (force > 0.0f) scene.list.add(LegendEntry{kForceColor, text});
  std::snprintf(text, sizeof text, "torque, longest %.3g N m", double(torque));
  if (torque > 0.0f) scene.list.add(LegendEntry{kTorqueColor, text});
}

}  // namespace

void addJointOverlays(const OverlayScene& scene) {
  const pfx::World& world = scene.world;
  if (scene.overlays.forces) addLoads(scene);
  if (!scene.overlays.limits) return;
  for (uint32_t i = 0; i < world.jointLinks().size(); ++i) {
    const pfx::JointLink& link = world.jointLinks()[i];
    if (!link.exists || (!scene.shows(link.body_a) && !scene.shows(link.body_b))) continue;
    const pfx::Joint& joint = world.joints()[i];
    const pfx::Transform a = world.states()[link.body_a].pose(), b = world.states()[link.body_b].pose();
    const Placed placed = {a * pfx::Transform{joint.anchor_a, joint.frame_a},
                           pfx::measureJoint(joint, pfx::toDouble(a), pfx::toDouble(b)), 0.5f * scene.unit,
                           pickId(PickKind::Joint, i)};
    addLimits(scene, joint, placed, b);
  }
}

}  // namespace viewer
