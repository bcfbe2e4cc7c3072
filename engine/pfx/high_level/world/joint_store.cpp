#include "pfx/high_level/world/joint_store.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pfx {
namespace {

[[noreturn]] void reject(const JointDef& def, const std::string& what) {
  throw std::invalid_argument("joint \"" + def.name + "\": " + what);
}

void requireShare(const JointDef& def, float x, const char* field) {
  if (!(x >= 0.0f && x <= 1.0f))
    reject(def, std::string(field) + " = " + std::to_string(x) + ", must be 0 .. 1");
}

void check(const JointDef& def, const Joint& j) {
  if (!j.anchor_a.allFinite() || !j.anchor_b.allFinite()) reject(def, "an anchor is not finite");
  if (!(std::abs(j.frame_a.norm() - 1.0f) < 1e-3f) || !(std::abs(j.frame_b.norm() - 1.0f) < 1e-3f))
    reject(def, "a frame is not a rotation");
  if (!std::isfinite(j.gear_ratio) || j.gear_ratio == 0.0f)
    reject(def, "the gear ratio is zero or not finite");
  for (const AxisConstraint& c : j.axis) {
    if (std::isnan(c.lower) || std::isnan(c.upper)) reject(def, "a limit is not a number");
    if (c.lock == JointLock::Limit && c.lower > c.upper)
      reject(def, "the lower limit is above the upper one");
    requireShare(def, c.bias, "bias");
    requireShare(def, c.damping, "damping");
    requireShare(def, c.weight, "weight");
    const bool sane = c.max_force >= 0.0f && c.motor_max_force >= 0.0f && c.spring_frequency >= 0.0f &&
                      c.spring_damping >= 0.0f && std::isfinite(c.motor_speed) &&
                      std::isfinite(c.spring_target);
    if (!sane) reject(def, "a force, frequency or damping ratio is negative or not finite");
  }
  if (!(def.break_force > 0.0f) || !(def.break_torque > 0.0f))
    reject(def, "break force and torque must be > 0");
}

}  // namespace

Joint makeJoint(const RigidState& a, const RigidState& b, const JointParams& params) {
  struct Make {
    const RigidState &a, &b;
    Joint operator()(const BallJointParams& p) const { return makeBallJoint(a, b, p); }
    Joint operator()(const SwingTwistJointParams& p) const { return makeSwingTwistJoint(a, b, p); }
    Joint operator()(const HingeJointParams& p) const { return makeHingeJoint(a, b, p); }
    Joint operator()(const SliderJointParams& p) const { return makeSliderJoint(a, b, p); }
    Joint operator()(const FixedJointParams& p) const { return makeFixedJoint(a, b, p); }
    Joint operator()(const UniversalJointParams& p) const { return makeUniversalJoint(a, b, p); }
    Joint operator()(const DistanceJointParams& p) const { return makeDistanceJoint(a, b, p); }
    Joint operator()(const GearJointParams& p) const { return makeGearJoint(a, b, p); }
    Joint operator()(const Joint& joint) const { return joint; }
  };
  return std::visit(Make{a, b}, params);
}

JointId JointStore::add(const JointDef& def, const Joint& joint) {
  check(def, joint);
  const bool reuse = !free_slots.empty();
  const uint32_t index = reuse ? free_slots.back() : static_cast<uint32_t>(joints.size());
  if (reuse) {
    free_slots.pop_back();
  } else {
    joints.emplace_back(), links.emplace_back(), names.emplace_back();
    break_force.emplace_back(), break_torque.emplace_back(), generations.push_back(0);
  }
  joints[index] = joint;
  links[index] = {def.body_a.index, def.body_b.index, true, def.bodies_collide};
  names[index] = def.name;
  break_force[index] = def.break_force;
  break_torque[index] = def.break_torque;
  changed_ = true;
  return {index, ++generations[index]};
}

void JointStore::remove(uint32_t index) {
  joints[index] = Joint{};
  links[index] = {};
  names[index].clear();
  ++generations[index];
  free_slots.push_back(index);
  changed_ = true;
}

std::span<const uint64_t> JointStore::keptApart() {
  if (changed_) {
    kept_apart_.clear();
    for (const JointLink& l : links)
      if (l.exists && !l.bodies_collide)
        kept_apart_.push_back(
            Pair{.body_a = std::min(l.body_a, l.body_b), .body_b = std::max(l.body_a, l.body_b)}.key());
    std::sort(kept_apart_.begin(), kept_apart_.end());
    changed_ = false;
  }
  return kept_apart_;
}

}  // namespace pfx
