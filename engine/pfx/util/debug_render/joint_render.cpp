// Joints: anchors, frames, and the ranges in which their axes may move.
#include "pfx/util/debug_render/debug_render.h"

namespace pfx {
namespace {

constexpr Color kAnchorColor = 0xfff2f2f2;
constexpr Color kRangeColor = 0xff7fc8ff;
constexpr Color kAxisColors[3] = {0xffe05a4f, 0xff63b35c, 0xff4f86e0};

}  // namespace

void DebugRender::renderJoint(const Joint& joint, const Transform& body_a, const Transform& body_b) {
  const Transform a = body_a * Transform{joint.anchor_a, joint.frame_a};
  const Transform b = body_b * Transform{joint.anchor_b, joint.frame_b};
  const float size = 0.5f * scale;
  for (const Transform* frame : {&a, &b}) {
    if (callbacks.point != nullptr) callbacks.point(callbacks.context, frame->position, kAnchorColor);
    if (callbacks.line == nullptr) continue;
    for (int k = 0; k < 3; ++k)
      callbacks.line(callbacks.context, frame->position, frame->apply(size * Vec3::Unit(k)), kAxisColors[k]);
  }
  for (int k = 0; k < 3; ++k) {
    const AxisConstraint& range = joint.axis[k];
    if (range.lock == JointLock::Limit && callbacks.line != nullptr)
      callbacks.line(callbacks.context, a.apply(range.lower * Vec3::Unit(k)), a.apply(range.upper * Vec3::Unit(k)),
                     kRangeColor);
  }
  if (callbacks.arc == nullptr) return;
  const auto arc = [&](int about, int from, float lower, float upper) {
    callbacks.arc(callbacks.context, a.position, a.orientation * Vec3::Unit(about), a.orientation * Vec3::Unit(from),
                  size, lower, upper, kRangeColor);
  };
  // Twist turns y about x; swing turns x about y and about z. A cone opens alike in all directions.
  if (joint.axis[3].lock == JointLock::Limit) arc(0, 1, joint.axis[3].lower, joint.axis[3].upper);
  for (int k = 4; k < kNumJointAxes; ++k) {
    const AxisConstraint& range = joint.axis[joint.cone ? 4 : k];
    if (range.lock == JointLock::Limit) arc(k - 3, 0, joint.cone ? -range.upper : range.lower, range.upper);
  }
}

}  // namespace pfx
