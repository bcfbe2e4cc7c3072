// Joints of a scene file: the kinds with their parameters, or the whole record.
#include "pfx/high_level/scene_file/read_joint.h"

#include <array>

#include "pfx/high_level/scene_file/names.h"

namespace pfx {
namespace {

void readFrame(XmlElement& e, JointFrame& frame) {
  if (!e.has("frame")) return;
  Quat q;
  e.read("frame", q);
  frame = q.toRotationMatrix();
}

// What several kinds have in common.
template <class Params>
void readCommon(XmlElement& e, Params& p) {
  if constexpr (requires { p.anchor_point; }) e.read("anchor", p.anchor_point);
  if constexpr (requires { p.damping; }) e.read("damping", p.damping);
  if constexpr (requires { p.bias; }) e.read("bias", p.bias);
  if constexpr (requires { p.joint_frame; }) readFrame(e, p.joint_frame);
}

JointParams readBall(XmlElement& e) {
  BallJointParams p;
  readCommon(e, p);
  return p;
}

JointParams readSwingTwist(XmlElement& e) {
  SwingTwistJointParams p;
  readCommon(e, p);
  e.read("axis", p.twist_axis);
  e.read("twist-lower", p.twist_lower_angle);
  e.read("twist-upper", p.twist_upper_angle);
  e.read("swing-lower", p.swing_lower_angle);
  e.read("swing-upper", p.swing_upper_angle);
  return p;
}

JointParams readHinge(XmlElement& e) {
  HingeJointParams p;
  readCommon(e, p);
  e.read("axis", p.axis);
  e.read("lower", p.lower_angle);
  e.read("upper", p.upper_angle);
  return p;
}

JointParams readSlider(XmlElement& e) {
  SliderJointParams p;
  readCommon(e, p);
  e.read("axis", p.direction);
  e.read("lower", p.lower_distance);
  e.read("upper", p.upper_distance);
  return p;
}

JointParams readFixed(XmlElement& e) {
  FixedJointParams p;
  readCommon(e, p);
  return p;
}

JointParams readUniversal(XmlElement& e) {
  UniversalJointParams p;
  readCommon(e, p);
  e.read("axis", p.axis);
  e.read("up", p.up_vec);
  e.read("swing1-lower", p.swing1_lower_angle);
  e.read("swing1-upper", p.swing1_upper_angle);
  e.read("swing2-lower", p.swing2_lower_angle);
  e.read("swing2-upper", p.swing2_upper_angle);
  return p;
}

JointParams readDistance(XmlElement& e) {
  DistanceJointParams p;
  e.read("anchor-a", p.anchor_point_a);
  e.read("anchor-b", p.anchor_point_b);
  e.read("lower", p.lower_distance);
  e.read("upper", p.upper_distance);
  e.read("spring-frequency", p.spring_frequency);
  e.read("spring-damping", p.spring_damping);
  return p;
}

JointParams readGear(XmlElement& e) {
  GearJointParams p;
  e.read("axis-a", p.axis_a);
  e.read("axis-b", p.axis_b);
  e.read("ratio", p.ratio);
  return p;
}

JointParams readRecord(XmlElement& e) {
  Joint j;
  e.readName("kind", j.kind, scene_names::kJointKinds);
  e.read("cone", j.cone);
  e.read("anchor-a", j.anchor_a);
  e.read("anchor-b", j.anchor_b);
  e.read("frame-a", j.frame_a);
  e.read("frame-b", j.frame_b);
  e.read("gear-ratio", j.gear_ratio);
  e.read("gear-angle-a", j.gear_angle_a);
  e.read("gear-angle-b", j.gear_angle_b);
  e.read("gear-zero-a", j.gear_zero_a);
  e.read("gear-zero-b", j.gear_zero_b);
  return j;
}

struct Kind {
  std::string_view tag;
  JointParams (*read)(XmlElement&);
};
constexpr Kind kKinds[] = {
    {"ball", readBall},           {"swing-twist", readSwingTwist}, {"hinge", readHinge},
    {"slider", readSlider},       {"fixed", readFixed},            {"universal", readUniversal},
    {"distance", readDistance},   {"gear", readGear},              {"joint", readRecord}};

// The axis as it would be without the element, changed by what the element says.
std::pair<int, AxisConstraint> readAxis(XmlElement& e) {
  e.requiredText("name");
  int index = 0;
  e.readName("name", index, scene_names::kAxes);
  AxisConstraint c;
  e.readName("lock", c.lock, scene_names::kLocks);
  e.read("lower", c.lower);
  e.read("upper", c.upper);
  e.read("bias", c.bias);
  e.read("damping", c.damping);
  e.read("weight", c.weight);
  e.read("max-force", c.max_force);
  e.read("motor-speed", c.motor_speed);
  e.read("motor-max-force", c.motor_max_force);
  e.read("spring-frequency", c.spring_frequency);
  e.read("spring-damping", c.spring_damping);
  e.read("spring-target", c.spring_target);
  e.read("force", c.force);
  e.finish();
  return {index, c};
}

}  // namespace

std::span<const std::string_view> jointTags() {
  static constexpr auto kTags = [] {
    std::array<std::string_view, std::size(kKinds)> tags;
    for (size_t i = 0; i < tags.size(); ++i) tags[i] = kKinds[i].tag;
    return tags;
  }();
  return kTags;
}

SceneJoint readJoint(XmlElement& e) {
  SceneJoint joint;
  joint.place = e.place();
  joint.def.name = e.text("name", "");
  e.read("bodies-collide", joint.def.bodies_collide);
  e.read("break-force", joint.def.break_force);
  e.read("break-torque", joint.def.break_torque);
  for (const Kind& k : kKinds)
    if (k.tag == e.tag()) joint.def.params = k.read(e);
  e.finish();
  for (XmlElement& axis : e.children({"axis"})) joint.axes.push_back(readAxis(axis));
  return joint;
}

}  // namespace pfx
