#include "pfx/high_level/world/body_drag.h"

#include <stdexcept>

namespace pfx {

void BodyDrag::begin(World& world, BodyId body, const Vec3& point, float strength) {
  end(world);
  if (!world.isValid(body) || !isDynamic(world.states()[body.index].motion_type))
    throw std::invalid_argument("drag: only a dynamic body can be dragged");
  if (!world.isValid(hand_))
    hand_ = world.addBody({.name = "hand",
                           .motion_type = MotionType::Fixed,
                           .shapes = {{Sphere{1e-3f}}},
                           .filter_self = 0,
                           .filter_target = 0});
  Joint joint =
      makeBallJoint(world.states()[hand_.index], world.states()[body.index], {.anchor_point = point});
  const float mass = world.bodies()[body.index].mass;
  for (int i = 0; i < 3; ++i) {
    joint.axis[i].max_force = strength * mass;
    joint.axis[i].bias = 0.2f;
  }
  joint_ = world.addJoint({.name = "drag", .body_a = hand_, .body_b = body, .params = joint});
}

void BodyDrag::move(World& world, const Vec3& target) {
  if (!isHolding(world)) return;
  world.joint(joint_).anchor_a = world.states()[hand_.index].pose().applyInverse(target);
}

void BodyDrag::end(World& world) {
  world.removeJoint(joint_);
  joint_ = {};
}

}  // namespace pfx
