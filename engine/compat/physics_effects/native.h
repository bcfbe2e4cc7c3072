// How the records of the overview's API lie over the engine's own. Not part of the public headers.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

#include "compat/physics_effects/broadphase.h"
#include "compat/physics_effects/joint.h"
#include "compat/physics_effects/shape.h"
#include "compat/physics_effects/task.h"
#include "pfx/base_level/error.h"
#include "pfx/base_level/joint/joint.h"
#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/shape/aabb.h"
#include "pfx/base_level/shape/shape.h"
#include "pfx/low_level/task/task_manager.h"

namespace sce::PhysicsEffects {

struct PfxNativeConvexMesh : pfx::ConvexMesh {};
struct PfxNativeLargeMesh : pfx::LargeMesh {};

// A state begins as the engine's own does, so that it can be read as one.
struct NativeLayout {
  static_assert(offsetof(PfxRigidState, position_) == offsetof(pfx::RigidState, position));
  static_assert(offsetof(PfxRigidState, orientation_) == offsetof(pfx::RigidState, orientation));
  static_assert(offsetof(PfxRigidState, linear_velocity_) == offsetof(pfx::RigidState, linear_velocity));
  static_assert(offsetof(PfxRigidState, angular_velocity_) == offsetof(pfx::RigidState, angular_velocity));
  static_assert(offsetof(PfxRigidState, body_id_) == offsetof(pfx::RigidState, body_id));
  static_assert(offsetof(PfxRigidState, filter_self_) == offsetof(pfx::RigidState, filter_self));
  static_assert(offsetof(PfxRigidState, sleep_count_) == offsetof(pfx::RigidState, sleep_count));
  static_assert(offsetof(PfxRigidState, motion_type_) == offsetof(pfx::RigidState, motion_type));
  static_assert(offsetof(PfxRigidState, asleep_) == offsetof(pfx::RigidState, asleep));
  static_assert(offsetof(PfxShape, position_) == offsetof(pfx::Transform, position));
  static_assert(offsetof(PfxShape, orientation_) == offsetof(pfx::Transform, orientation));
};

inline const pfx::RigidState& native(const PfxRigidState& s) { return reinterpret_cast<const pfx::RigidState&>(s); }
inline pfx::RigidState& native(PfxRigidState& s) { return reinterpret_cast<pfx::RigidState&>(s); }
inline const pfx::Transform& poseOf(const PfxRigidState& s) { return reinterpret_cast<const pfx::Transform&>(s); }

inline pfx::Vec3 native(const PfxVector3& v) { return {v[0], v[1], v[2]}; }
inline PfxVector3 compat(const pfx::Vec3& v) { return PfxVector3(v.x(), v.y(), v.z()); }
inline pfx::Quat native(const PfxQuat& q) { return {q[3], q[0], q[1], q[2]}; }
inline PfxQuat compat(const pfx::Quat& q) { return PfxQuat(q.x(), q.y(), q.z(), q.w()); }
// The columns of a matrix lie four numbers apart.
using MatrixColumns = Eigen::Map<const pfx::Mat3, 0, Eigen::OuterStride<4>>;
static_assert(sizeof(PfxMatrix3) == 12 * sizeof(float));
inline MatrixColumns columns(const PfxMatrix3& m) { return MatrixColumns(reinterpret_cast<const float*>(&m)); }
inline pfx::Mat3 native(const PfxMatrix3& m) { return columns(m); }

// The shape as the narrow phase takes it. Meshes are looked up now, so that one which was made anew is seen.
pfx::Shape native(const PfxShape& shape);
// Whether sizes are finite and meshes are there.
bool isValid(const PfxShape& shape);

// A joint as the engine takes it; m_maxImpulse (N s) stands in max_force.
pfx::Joint nativeJoint(const PfxJoint& joint);
pfx::AxisConstraint nativeAxis(const PfxJointConstraint& axis);

// Make the records of meshes that were built; memory comes from the utility allocator. The convex mesh keeps the vertices
// and triangles that it was made of. SCE_PFX_ERR_OUT_OF_BUFFER: no memory; SCE_PFX_ERR_OUT_OF_RANGE_ISLANDS.
PfxInt32 adoptConvexMesh(PfxConvexMesh& mesh, pfx::ConvexMesh&& built, std::span<const pfx::Vec3> vertices,
                         std::span<const uint32_t> indices);
PfxInt32 adoptLargeMesh(PfxLargeTriMesh& mesh, const pfx::LargeMesh& built);

// Takes the memory that contacts with meshes need on this thread, so that detection does not.
void reserveMeshContacts();

inline pfx::Aabb bodyAabb(const PfxRigidState& s, const PfxCollidable& c) {
  return pfx::transformedAabb(poseOf(s), native(c.getCenter()), native(c.getHalf()));
}

inline pfx::MotionType motionTypeOf(PfxUInt8 mask) { return static_cast<pfx::MotionType>(std::countr_zero(mask)); }

// A table over motion types: which types (bits) go with each.
using MotionTable = std::array<PfxUInt8, kPfxMotionTypeCount>;
template <class Fn>
constexpr MotionTable motionTable(Fn&& goes) {
  MotionTable table = {};
  for (int a = 0; a < kPfxMotionTypeCount; ++a)
    for (int b = 0; b < kPfxMotionTypeCount; ++b)
      if (goes(static_cast<pfx::MotionType>(a), static_cast<pfx::MotionType>(b))) table[a] |= static_cast<PfxUInt8>(1 << b);
  return table;
}
inline constexpr MotionTable kDetected = motionTable(pfx::detectsCollision);
inline constexpr MotionTable kSolved = motionTable(pfx::solvesConstraint);

// Whether two bodies may meet by a table, and are not both asleep.
inline bool meetBy(const MotionTable& table, const PfxRigidState& a, const PfxRigidState& b) {
  const pfx::RigidState &na = native(a), &nb = native(b);
  return (table[static_cast<size_t>(na.motion_type)] >> static_cast<int>(nb.motion_type) & 1) != 0 && !(na.asleep && nb.asleep);
}

inline pfx::TaskManager* poolOf(const PfxTaskManager* tasks) {
  return tasks == nullptr ? nullptr : static_cast<pfx::TaskManager*>(tasks->getPool());
}

inline bool aligned16(const void* p) { return reinterpret_cast<uintptr_t>(p) % 16 == 0; }

// NULL, alignment, and whether all bodies are there (num_bodies = 0: not known).
PfxInt32 checkPairs(const PfxConstraintPair* pairs, PfxUInt32 count, PfxUInt32 num_bodies);

inline PfxInt32 errorCode(pfx::Error e) {
  switch (e) {
    case pfx::Error::Ok: return SCE_PFX_OK;
    case pfx::Error::OutOfRange: return SCE_PFX_ERR_OUT_OF_RANGE;
    case pfx::Error::InvalidAlignment: return SCE_PFX_ERR_INVALID_ALIGN;
    case pfx::Error::OutOfBuffer: return SCE_PFX_ERR_OUT_OF_BUFFER;
    case pfx::Error::OutOfMaxPairs: return SCE_PFX_ERR_OUT_OF_MAX_PAIRS;
    case pfx::Error::OutOfWorld: return SCE_PFX_ERR_OUT_OF_WORLD;
    default: return SCE_PFX_ERR_INVALID_VALUE;
  }
}

}  // namespace sce::PhysicsEffects
