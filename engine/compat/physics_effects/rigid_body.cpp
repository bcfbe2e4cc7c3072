#include "compat/physics_effects/rigid_body.h"

#include "compat/physics_effects/native.h"

namespace sce::PhysicsEffects {

void PfxRigidState::reset() {
  setPosition(PfxVector3(0.0f));
  setOrientation(PfxQuat::identity());
  setLinearVelocity(PfxVector3(0.0f));
  setAngularVelocity(PfxVector3(0.0f));
  body_id_ = 0;
  filter_self_ = filter_target_ = 0xffffffffu;
  sleep_count_ = 0;
  motion_type_ = kPfxMotionTypeActive;
  use_sleep_ = 1;
  asleep_ = 0;
  linear_damping_ = 1.0f;
  angular_damping_ = 0.99f;
  max_linear_velocity_ = 340.0f;
  max_angular_velocity_ = 60.0f * SCE_PFX_PI;
  for (PfxUInt32& param : user_param_) param = 0;
  user_data_ = nullptr;
}

void PfxRigidState::sleep() {
  if (!canSleep()) return;
  asleep_ = 1;
  setLinearVelocity(PfxVector3(0.0f));
  setAngularVelocity(PfxVector3(0.0f));
}

void PfxRigidState::movePosition(const PfxVector3& position, PfxFloat timeStep) {
  if (motion_type_ != kPfxMotionTypeKeyframe || !(timeStep > 0.0f)) return;
  setLinearVelocity((position - getPosition()) / timeStep);
}

// The rotation vector of the way there, the shorter way round.
void PfxRigidState::moveOrientation(const PfxQuat& orientation, PfxFloat timeStep) {
  if (motion_type_ != kPfxMotionTypeKeyframe || !(timeStep > 0.0f)) return;
  PfxQuat way = orientation * conj(getOrientation());
  if (way[3] < 0.0f) way = -way;
  const PfxFloat sine = length(way.getXYZ());
  const PfxFloat angle = 2.0f * pfx::atan2(sine, way[3]);
  setAngularVelocity(sine > 0.0f ? way.getXYZ() * (angle / (sine * timeStep)) : PfxVector3(0.0f));
}

void PfxRigidBody::reset() {
  setMass(1.0f);
  setInertia(PfxMatrix3::identity());
  restitution_ = 0.2f;
  friction_ = 0.6f;
  user_data_ = nullptr;
}

void PfxRigidBody::setInertia(const PfxMatrix3& inertia) {
  inertia_ = inertia;
  const PfxFloat volume = determinant(inertia);
  inertia_inv_ = volume > 0.0f && volume < 1e30f ? inverse(inertia) : PfxMatrix3(0.0f);
}

PfxFloat pfxCalcMassBox(PfxFloat density, const PfxVector3& h) { return density * 8.0f * h[0] * h[1] * h[2]; }
PfxFloat pfxCalcMassSphere(PfxFloat density, PfxFloat r) { return density * 4.0f / 3.0f * SCE_PFX_PI * r * r * r; }
PfxFloat pfxCalcMassCylinder(PfxFloat density, PfxFloat half, PfxFloat r) {
  return density * 2.0f * half * SCE_PFX_PI * r * r;
}
PfxFloat pfxCalcMassCapsule(PfxFloat density, PfxFloat half, PfxFloat r) {
  return pfxCalcMassCylinder(density, half, r) + pfxCalcMassSphere(density, r);
}

namespace {

PfxMatrix3 diagonal(PfxFloat x, PfxFloat y, PfxFloat z) { return PfxMatrix3::scale(PfxVector3(x, y, z)); }

// Moments along the axis of a solid of revolution and across it.
struct Moments {
  PfxFloat along, across;
};
Moments cylinder(PfxFloat half, PfxFloat r, PfxFloat mass) {
  return {0.5f * mass * r * r, mass * (0.25f * r * r + half * half / 3.0f)};
}
// A cylinder and two half balls; the centre of a half ball lies 3/8 r from its base.
Moments capsule(PfxFloat half, PfxFloat r, PfxFloat mass) {
  const PfxFloat tube_volume = 2.0f * half, ball_volume = 4.0f / 3.0f * r;
  const PfxFloat ball_mass = mass * ball_volume / (tube_volume + ball_volume);
  const Moments tube = cylinder(half, r, mass - ball_mass);
  const PfxFloat ball = 0.4f * ball_mass * r * r;
  return {tube.along + ball, tube.across + ball + ball_mass * (half * half + 0.75f * half * r)};
}

}  // namespace

PfxMatrix3 pfxCalcInertiaBox(const PfxVector3& h, PfxFloat mass) {
  const PfxFloat x = h[0] * h[0], y = h[1] * h[1], z = h[2] * h[2];
  return diagonal(y + z, x + z, x + y) * (mass / 3.0f);
}
PfxMatrix3 pfxCalcInertiaSphere(PfxFloat r, PfxFloat mass) { return PfxMatrix3::identity() * (0.4f * mass * r * r); }
PfxMatrix3 pfxCalcInertiaCylinderX(PfxFloat half, PfxFloat r, PfxFloat mass) {
  const Moments m = cylinder(half, r, mass);
  return diagonal(m.along, m.across, m.across);
}
PfxMatrix3 pfxCalcInertiaCylinderY(PfxFloat half, PfxFloat r, PfxFloat mass) {
  const Moments m = cylinder(half, r, mass);
  return diagonal(m.across, m.along, m.across);
}
PfxMatrix3 pfxCalcInertiaCylinderZ(PfxFloat half, PfxFloat r, PfxFloat mass) {
  const Moments m = cylinder(half, r, mass);
  return diagonal(m.across, m.across, m.along);
}
PfxMatrix3 pfxCalcInertiaCapsuleX(PfxFloat half, PfxFloat r, PfxFloat mass) {
  const Moments m = capsule(half, r, mass);
  return diagonal(m.along, m.across, m.across);
}
PfxMatrix3 pfxCalcInertiaCapsuleY(PfxFloat half, PfxFloat r, PfxFloat mass) {
  const Moments m = capsule(half, r, mass);
  return diagonal(m.across, m.along, m.across);
}
PfxMatrix3 pfxCalcInertiaCapsuleZ(PfxFloat half, PfxFloat r, PfxFloat mass) {
  const Moments m = capsule(half, r, mass);
  return diagonal(m.across, m.across, m.along);
}
PfxMatrix3 pfxMassTranslate(PfxFloat mass, const PfxMatrix3& inertia, const PfxVector3& t) {
  const PfxMatrix3 c = crossMatrix(t);
  return inertia - mass * (c * c);
}
PfxMatrix3 pfxMassRotate(const PfxMatrix3& inertia, const PfxMatrix3& rotation) {
  return rotation * inertia * transpose(rotation);
}

}  // namespace sce::PhysicsEffects
