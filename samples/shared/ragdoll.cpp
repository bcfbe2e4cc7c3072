#include "samples/shared/ragdoll.h"

#include "pfx/base_level/rigid_body/mass_properties.h"
#include "pfx/base_level/rigid_body/rotation_update.h"

namespace samples {
namespace {

using namespace pfx;

constexpr float kRightAngle = 1.57f;
constexpr float kDamping = 0.05f;

struct Builder {
  World& world;
  const std::string& name;
  Transform pose;
  float inertia_scale;
  Ragdoll out = {};
  size_t num_joints = 0, num_hinges = 0;

  void add(Ragdoll::Part part, const char* what, const Geometry& geometry, const Transform& at, float mass) {
    const std::vector<Shape> shapes = {{geometry, {}}};
    const Mat3 inertia = scaledToMass(massProperties(std::span<const Shape>(shapes), 1000.0f), mass)->inertia;
    out.bodies[part] = world.addBody({.name = name + " " + what,
                                      .pose = pose * at,
                                      .shapes = shapes,
                                      .mass = mass,
                                      .inertia = inertia_scale * inertia});
  }
  Vec3 point(const Vec3& p) const { return pose.apply(p); }
  Vec3 axis(const Vec3& a) const { return pose.orientation * a; }

  JointId join(Ragdoll::Part a, Ragdoll::Part b, const char* what, const JointParams& params) {
    return out.joints[num_joints++] = world.addJoint({.name = name + " " + what,
                                                      .body_a = out.bodies[a],
                                                      .body_b = out.bodies[b],
                                                      .params = params});
  }
  void cone(Ragdoll::Part a, Ragdoll::Part b, const char* what, const Vec3& at, const Vec3& twist,
            float swing) {
    join(a, b, what,
         SwingTwistJointParams{.anchor_point = point(at),
                               .twist_axis = axis(twist),
                               .twist_lower_angle = -0.5f,
                               .twist_upper_angle = 0.5f,
                               .swing_upper_angle = swing,
                               .damping = kDamping});
  }
  void hinge(Ragdoll::Part a, Ragdoll::Part b, const char* what, const Vec3& at, const Vec3& about) {
    out.hinges[num_hinges++] = join(a, b, what,
                                    HingeJointParams{.anchor_point = point(at),
                                                     .axis = axis(about),
                                                     .lower_angle = 0.0f,
                                                     .upper_angle = kRightAngle,
                                                     .damping = kDamping});
  }
};

Transform upright(const Vec3& at) {
  return {.position = at, .orientation = expMap(0.5f * 3.14159265f * Vec3::UnitZ())};
}

void addTrunk(Builder& b) {
  b.add(Ragdoll::Pelvis, "pelvis", Capsule{0.1f, 0.38f}, {}, 8.0f);
  b.add(Ragdoll::Torso, "torso", Sphere{0.35f}, {.position = Vec3(0, 0.6f, 0)}, 10.0f);
  b.add(Ragdoll::Head, "head", Sphere{0.3f}, {.position = Vec3(0, 1.2f, 0)}, 3.0f);
  b.cone(Ragdoll::Pelvis, Ragdoll::Torso, "waist", Vec3(0, 0.3f, 0), Vec3::UnitY(), 0.4f);
  b.cone(Ragdoll::Torso, Ragdoll::Head, "neck", Vec3(0, 0.92f, 0), Vec3::UnitY(), 0.5f);
}

// side: +1 for the limbs at +X (its left), -1 for the others. Knees bend backwards, elbows forwards, legs
// swing outwards by 0.52 and forwards by a right angle.
void addLeg(Builder& b, float side) {
  const bool left = side > 0.0f;
  const auto upper = left ? Ragdoll::UpperLegL : Ragdoll::UpperLegR;
  const auto lower = left ? Ragdoll::LowerLegL : Ragdoll::LowerLegR;
  const float x = 0.24f * side;
  b.add(upper, left ? "left thigh" : "right thigh", Capsule{0.24f, 0.16f}, upright(Vec3(x, -0.7f, 0)), 8.0f);
  b.add(lower, left ? "left shin" : "right shin", Capsule{0.28f, 0.13f}, upright(Vec3(x, -1.44f, 0)), 4.0f);
  b.join(Ragdoll::Pelvis, upper, left ? "left hip" : "right hip",
         UniversalJointParams{.anchor_point = b.point(Vec3(x, -0.38f, 0)),
                              .axis = b.axis(-Vec3::UnitY()),
                              .up_vec = b.axis(Vec3::UnitZ()),
                              .swing1_lower_angle = left ? 0.0f : -0.52f,
                              .swing1_upper_angle = left ? 0.52f : 0.0f,
                              .swing2_lower_angle = 0.0f,
                              .swing2_upper_angle = kRightAngle,
                              .damping = kDamping});
  b.hinge(upper, lower, left ? "left knee" : "right knee", Vec3(x, -1.06f, 0), Vec3::UnitX());
}

void addArm(Builder& b, float side) {
  const bool left = side > 0.0f;
  const auto upper = left ? Ragdoll::UpperArmL : Ragdoll::UpperArmR;
  const auto lower = left ? Ragdoll::LowerArmL : Ragdoll::LowerArmR;
  const auto at = [&](float x) { return Vec3(x * side, 0.68f, 0); };
  b.add(upper, left ? "left upper arm" : "right upper arm", Capsule{0.2f, 0.12f}, {.position = at(0.72f)},
        5.0f);
  b.add(lower, left ? "left forearm" : "right forearm", Capsule{0.2f, 0.1f}, {.position = at(1.34f)}, 3.0f);
  b.cone(Ragdoll::Torso, upper, left ? "left shoulder" : "right shoulder", at(0.4f), side * Vec3::UnitX(),
         kRightAngle);
  b.hinge(upper, lower, left ? "left elbow" : "right elbow", at(1.03f), -side * Vec3::UnitY());
}

}  // namespace

Ragdoll addRagdoll(World& world, const std::string& name, const Transform& pose, float inertia_scale) {
  Builder b{world, name, pose, inertia_scale};
  addTrunk(b);
  for (const float side : {1.0f, -1.0f}) {
    addLeg(b, side);
    addArm(b, side);
  }
  return b.out;
}

}  // namespace samples
