// State and attributes of a rigid body, motion types, inertia of simple solids.
#pragma once

#include "base.h"

namespace sce {
namespace PhysicsEffects {

// How a body moves, and what its contacts do.
enum ePfxMotionType {
  kPfxMotionTypeFixed = 0,  // infinite mass, never moves
  kPfxMotionTypeActive,     // moves by the laws of mechanics
  kPfxMotionTypeKeyframe,   // pose after the step comes from outside; pushes, is not pushed
  kPfxMotionTypeOneWay,     // is pushed, does not push
  kPfxMotionTypeTrigger,    // neither; its contacts are recorded
  kPfxMotionTypeCount
};

// Motion type, as the bit of its number, and sleep, as they stand in pairs and proxies.
#define SCE_PFX_MOTION_MASK_DYNAMIC 0x0a   // Active, OneWay: gives way
#define SCE_PFX_MOTION_MASK_STATIC 0x95    // Fixed, Keyframe, Trigger, and whatever sleeps
#define SCE_PFX_MOTION_MASK_SLEEP 0x0e     // Active, Keyframe, OneWay: can sleep
#define SCE_PFX_MOTION_MASK_TYPE 0x7f
#define SCE_PFX_MOTION_MASK_SLEEPING 0x80
#define SCE_PFX_MOTION_MASK_CAN_SLEEP(motionType) (((1 << (motionType)) & SCE_PFX_MOTION_MASK_SLEEP) != 0)

// What changes in every step. Lengths in m, velocities in m/s and rad/s in world axes. The first members lie as in the
// engine's own record.
class PfxRigidState {
 public:
  PfxRigidState() { reset(); }
  // Active at the origin and at rest, filters all ones.
  void reset();

  // Pose (m) and velocities of the centre of mass.
  PfxVector3 getPosition() const { return pfxReadVector3(position_); }
  PfxQuat getOrientation() const { return pfxReadQuat(orientation_); }
  PfxVector3 getLinearVelocity() const { return pfxReadVector3(linear_velocity_); }
  PfxVector3 getAngularVelocity() const { return pfxReadVector3(angular_velocity_); }
  void setPosition(const PfxVector3& v) { pfxStoreVector3(v, position_); }
  void setPosition(const PfxPoint3& p) { pfxStorePoint3(p, position_); }
  void setOrientation(const PfxQuat& q) { pfxStoreQuat(q, orientation_); }
  void setLinearVelocity(const PfxVector3& v) { setLinearVelocity(v, PfxVector3(0.0f)); }
  void setAngularVelocity(const PfxVector3& v) { setAngularVelocity(v, PfxVector3(0.0f)); }
  // With a part that lasts until the next update of the states only: the solver parts overlapping bodies with it.
  void setLinearVelocity(const PfxVector3& v, const PfxVector3& passing) {
    pfxStoreVector3(v, linear_velocity_), pfxStoreVector3(passing, passing_linear_);
  }
  void setAngularVelocity(const PfxVector3& v, const PfxVector3& passing) {
    pfxStoreVector3(v, angular_velocity_), pfxStoreVector3(passing, passing_angular_);
  }
  PfxVector3 getPassingLinearVelocity() const { return pfxReadVector3(passing_linear_); }
  PfxVector3 getPassingAngularVelocity() const { return pfxReadVector3(passing_angular_); }

  // The velocity that takes a keyframe body to a pose within `timeStep`; the next update of the states does the rest.
  // Other motion types are not moved.
  void movePosition(const PfxVector3& position, PfxFloat timeStep);
  void moveOrientation(const PfxQuat& orientation, PfxFloat timeStep);
  void moveTransform(const PfxTransform3& pose, PfxFloat timeStep) {
    movePosition(pose.getTranslation(), timeStep), moveOrientation(PfxQuat(pose.getUpper3x3()), timeStep);
  }

  // Index of the body in the three arrays.
  PfxUInt16 getRigidBodyId() const { return static_cast<PfxUInt16>(body_id_); }
  void setRigidBodyId(PfxUInt16 id) { body_id_ = id; }
  // A pair survives when self of each meets target of the other.
  PfxUInt32 getContactFilterSelf() const { return filter_self_; }
  PfxUInt32 getContactFilterTarget() const { return filter_target_; }
  void setContactFilterSelf(PfxUInt32 filter) { filter_self_ = filter; }
  void setContactFilterTarget(PfxUInt32 filter) { filter_target_ = filter; }

  // How it moves, and the same as a bit, with or without sleep.
  ePfxMotionType getMotionType() const { return static_cast<ePfxMotionType>(motion_type_); }
  void setMotionType(ePfxMotionType type) { motion_type_ = static_cast<PfxUInt8>(type); }
  void setMotionType(PfxUInt8 type) { motion_type_ = type; }
  PfxUInt8 getMotionTypeMask() const { return static_cast<PfxUInt8>(1 << motion_type_); }
  PfxUInt8 getMotionMask() const {
    return static_cast<PfxUInt8>(1 << motion_type_ | (asleep_ ? SCE_PFX_MOTION_MASK_SLEEPING : 0));
  }

  // The low level never puts a body to sleep by itself. Only Active, Keyframe and OneWay bodies that use sleep can.
  PfxUInt8 getUseSleep() const { return use_sleep_; }
  void setUseSleep(PfxUInt8 use) { use_sleep_ = use != 0; }
  bool canSleep() const {
    return use_sleep_ != 0 && SCE_PFX_MOTION_MASK_CAN_SLEEP(motion_type_);
  }
  void sleep();
  void wakeup() { asleep_ = 0, sleep_count_ = 0; }
  bool isAsleep() const { return asleep_ != 0; }
  bool isAwake() const { return asleep_ == 0; }
  PfxUInt16 getSleepCount() const { return static_cast<PfxUInt16>(sleep_count_); }
  void incrementSleepCount() { sleep_count_ += sleep_count_ < 0xffff; }
  void resetSleepCount() { sleep_count_ = 0; }

  // Share of the velocity that remains after 1/60 s, 0 .. 1, whatever the time step.
  PfxFloat getLinearDamping() const { return linear_damping_; }
  PfxFloat getAngularDamping() const { return angular_damping_; }
  void setLinearDamping(PfxFloat damping) { linear_damping_ = damping; }
  void setAngularDamping(PfxFloat damping) { angular_damping_ = damping; }
  PfxFloat getMaxLinearVelocity() const { return max_linear_velocity_; }
  PfxFloat getMaxAngularVelocity() const { return max_angular_velocity_; }
  void setMaxLinearVelocity(PfxFloat v) { max_linear_velocity_ = v; }
  void setMaxAngularVelocity(PfxFloat v) { max_angular_velocity_ = v; }
  void* getUserData() const { return user_data_; }
  void setUserData(void* data) { user_data_ = data; }
  PfxUInt32 getUserParam(int i) const { return user_param_[i]; }
  void setUserParam(int i, PfxUInt32 value) { user_param_[i] = value; }

 private:
  friend struct NativeLayout;
  friend struct PfxSerializeAccess;
  PfxFloat position_[3];
  PfxFloat orientation_[4];
  PfxFloat linear_velocity_[3];
  PfxFloat angular_velocity_[3];
  PfxUInt32 body_id_;
  PfxUInt32 filter_self_;
  PfxUInt32 filter_target_;
  PfxUInt32 sleep_count_;
  PfxUInt8 motion_type_;
  PfxUInt8 use_sleep_;
  PfxUInt8 asleep_;
  PfxFloat linear_damping_;
  PfxFloat angular_damping_;
  PfxFloat max_linear_velocity_;
  PfxFloat max_angular_velocity_;
  PfxFloat passing_linear_[3];
  PfxFloat passing_angular_[3];
  PfxUInt32 user_param_[4];
  void* user_data_;
};

// What a body is made of: mass (kg), inertia (kg m^2, body axes), surface.
class PfxRigidBody {
 public:
  PfxRigidBody() { reset(); }
  // 1 kg with unit inertia, restitution 0.2, friction 0.6.
  void reset();

  // kg, and 1/kg; no mass at all gives way to no force.
  PfxFloat getMass() const { return mass_; }
  PfxFloat getMassInv() const { return mass_inv_; }
  void setMass(PfxFloat mass) { mass_ = mass, mass_inv_ = mass > 0.0f ? 1.0f / mass : 0.0f; }
  void setMassInv(PfxFloat inverse) { mass_inv_ = inverse; }
  const PfxMatrix3& getInertia() const { return inertia_; }
  const PfxMatrix3& getInertiaInv() const { return inertia_inv_; }
  // A tensor that has no inverse gives way to no torque.
  void setInertia(const PfxMatrix3& inertia);
  void setInertiaInv(const PfxMatrix3& inverse) { inertia_inv_ = inverse; }
  // Of the surface, 0 .. 1: restitutions are averaged, of frictions the geometric mean is taken. Data of the application.
  PfxFloat getRestitution() const { return restitution_; }
  void setRestitution(PfxFloat restitution) { restitution_ = restitution; }
  PfxFloat getFriction() const { return friction_; }
  void setFriction(PfxFloat friction) { friction_ = friction; }
  void* getUserData() const { return user_data_; }
  void setUserData(void* data) { user_data_ = data; }

 private:
  friend struct PfxSerializeAccess;
  PfxMatrix3 inertia_, inertia_inv_;
  PfxFloat mass_, mass_inv_, restitution_, friction_;
  void* user_data_;
};

// Mass (kg) of a solid of density kg/m^3.
PfxFloat pfxCalcMassBox(PfxFloat density, const PfxVector3& halfExtent);
PfxFloat pfxCalcMassSphere(PfxFloat density, PfxFloat radius);
PfxFloat pfxCalcMassCylinder(PfxFloat density, PfxFloat halfLength, PfxFloat radius);
PfxFloat pfxCalcMassCapsule(PfxFloat density, PfxFloat halfLength, PfxFloat radius);

// Inertia (kg m^2) of a solid of mass kg about its centre; cylinders and capsules lie along the axis in the name.
PfxMatrix3 pfxCalcInertiaBox(const PfxVector3& halfExtent, PfxFloat mass);
PfxMatrix3 pfxCalcInertiaSphere(PfxFloat radius, PfxFloat mass);
PfxMatrix3 pfxCalcInertiaCylinderX(PfxFloat halfLength, PfxFloat radius, PfxFloat mass);
PfxMatrix3 pfxCalcInertiaCylinderY(PfxFloat halfLength, PfxFloat radius, PfxFloat mass);
PfxMatrix3 pfxCalcInertiaCylinderZ(PfxFloat halfLength, PfxFloat radius, PfxFloat mass);
PfxMatrix3 pfxCalcInertiaCapsuleX(PfxFloat halfLength, PfxFloat radius, PfxFloat mass);
PfxMatrix3 pfxCalcInertiaCapsuleY(PfxFloat halfLength, PfxFloat radius, PfxFloat mass);
PfxMatrix3 pfxCalcInertiaCapsuleZ(PfxFloat halfLength, PfxFloat radius, PfxFloat mass);
// The tensor of a mass that is moved away from the centre (parallel axes), and of one that is turned.
PfxMatrix3 pfxMassTranslate(PfxFloat mass, const PfxMatrix3& inertia, const PfxVector3& translation);
PfxMatrix3 pfxMassRotate(const PfxMatrix3& inertia, const PfxMatrix3& rotation);

}  // namespace PhysicsEffects
}  // namespace sce
