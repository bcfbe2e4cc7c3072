// What a world needs to know to make a joint, and the handle it gives back.
#pragma once

#include <limits>
#include <string>
#include <variant>

#include "pfx/base_level/joint/ball_joint.h"
#include "pfx/base_level/joint/distance_joint.h"
#include "pfx/base_level/joint/fixed_joint.h"
#include "pfx/base_level/joint/gear_joint.h"
#include "pfx/base_level/joint/hinge_joint.h"
#include "pfx/base_level/joint/joint_coordinates.h"
#include "pfx/base_level/joint/slider_joint.h"
#include "pfx/base_level/joint/swing_twist_joint.h"
#include "pfx/base_level/joint/universal_joint.h"

namespace pfx {

// One of the kinds, or a record that was put together by hand.
using JointParams =
    std::variant<BallJointParams, SwingTwistJointParams, HingeJointParams, SliderJointParams,
                 FixedJointParams, UniversalJointParams, DistanceJointParams, GearJointParams, Joint>;

// The joint of two bodies where they stand now.
Joint makeJoint(const RigidState& a, const RigidState& b, const JointParams& params);

// Names a body; stays invalid after the body was removed, even when its slot is used again. Zero is null.
struct BodyId {
  uint32_t index = 0;
  uint32_t generation = 0;
  explicit operator bool() const { return generation != 0; }
  bool operator==(const BodyId&) const = default;
};

// Likewise for a joint.
struct JointId {
  uint32_t index = 0;
  uint32_t generation = 0;
  explicit operator bool() const { return generation != 0; }
  bool operator==(const JointId&) const = default;
};

struct JointDef {
  std::string name = {};  // for inspectors and files; need not be unique
  BodyId body_a = {};     // the joint's axes move with it
  BodyId body_b = {};
  JointParams params = BallJointParams{};
  bool bodies_collide = false;                                  // with each other
  float break_force = std::numeric_limits<float>::infinity();   // N; the joint is removed beyond it
  float break_torque = std::numeric_limits<float>::infinity();  // N m
};

// What a joint bears before it breaks.
struct JointStrength {
  float force;   // N
  float torque;  // N m
};

// A joint's place in the world; `exists` is false for slots that are free.
struct JointLink {
  uint32_t body_a = 0, body_b = 0;
  bool exists = false;
  bool bodies_collide = false;
};

}  // namespace pfx
