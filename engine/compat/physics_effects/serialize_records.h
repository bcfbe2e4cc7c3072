// The fields of the records, for any archive of pfx/util/serialize. Not part of the public headers.
#pragma once

#include "compat/physics_effects/native.h"
#include "compat/physics_effects/serialize.h"
#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/util/serialize/document.h"
#include "pfx/util/serialize/shape_records.h"

namespace sce::PhysicsEffects {

// The arrays of a file, in order: what refers to what refers to earlier ones.
enum SerializePart { kConvexMeshes, kLargeTriMeshes, kShapes, kStates, kBodies, kCollidables, kJoints, kContacts, kPairs, kNumParts };

using SerializeArrays = pfx::serial::RecordArray::Arrays;

template <class A>
void ioVector(A& a, const char* tag, PfxVector3& v) {
  a.open(tag);
  for (int i = 0; i < 3; ++i) a.number(v[i]);
  a.close();
  a.require(native(v).allFinite(), "a vector is not finite");
}
template <class A>
void ioMatrix(A& a, const char* tag, PfxMatrix3& m) {
  a.open(tag);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) a.number(m[i][k]);
  a.close();
}

// Knows the private members.
struct PfxSerializeAccess {
  template <class A>
  static void io(A& a, SerializeArrays, PfxRigidState& s) {
    using pfx::serial::field;
    field(a, "position", s.position_), field(a, "orientation", s.orientation_);
    field(a, "linear-velocity", s.linear_velocity_), field(a, "angular-velocity", s.angular_velocity_);
    field(a, "body-id", s.body_id_);
    field(a, "filter-self", s.filter_self_), field(a, "filter-target", s.filter_target_);
    field(a, "sleep-count", s.sleep_count_), field(a, "motion-type", s.motion_type_);
    field(a, "use-sleep", s.use_sleep_), field(a, "asleep", s.asleep_);
    field(a, "linear-damping", s.linear_damping_), field(a, "angular-damping", s.angular_damping_);
    field(a, "max-linear-velocity", s.max_linear_velocity_), field(a, "max-angular-velocity", s.max_angular_velocity_);
    field(a, "user-param", s.user_param_);
    a.require(s.motion_type_ < kPfxMotionTypeCount, "a motion type is unknown");
    a.require(native(s.getPosition()).allFinite() && native(s.getLinearVelocity()).allFinite() &&
                  native(s.getAngularVelocity()).allFinite(),
              "a state is not finite");
    a.require(std::abs(norm(s.getOrientation()) - 1.0f) < 1e-2f, "an orientation is not of length 1");
  }

  template <class A>
  static void io(A& a, SerializeArrays, PfxRigidBody& b) {
    using pfx::serial::field;
    ioMatrix(a, "inertia", b.inertia_), ioMatrix(a, "inverse-inertia", b.inertia_inv_);
    field(a, "mass", b.mass_), field(a, "inverse-mass", b.mass_inv_);
    field(a, "restitution", b.restitution_), field(a, "friction", b.friction_);
    a.require(b.mass_ >= 0.0f && b.mass_inv_ >= 0.0f && b.friction_ >= 0.0f && b.restitution_ >= 0.0f,
              "a mass or a property of the surface is negative or not a number");
  }

  template <class A>
  static void io(A& a, SerializeArrays all, PfxShape& s) {
    using pfx::serial::field;
    field(a, "type", s.type_), field(a, "size", s.size_);
    field(a, "offset-position", s.position_), field(a, "offset-orientation", s.orientation_);
    field(a, "filter-self", s.filter_self_), field(a, "filter-target", s.filter_target_);
    a.require(s.type_ < kPfxShapeCount, "a shape is of an unknown kind");
    if (s.type_ == kPfxShapeConvexMesh) ioMesh<PfxConvexMesh>(a, all[kConvexMeshes], s);
    if (s.type_ == kPfxShapeLargeTriMesh) ioMesh<PfxLargeTriMesh>(a, all[kLargeTriMeshes], s);
  }

  // A collidable with several shapes names them by their numbers in the array of shapes.
  template <class A>
  static void io(A& a, SerializeArrays all, PfxCollidable& c) {
    using pfx::serial::field;
    const pfx::serial::RecordArray& shapes = all[kShapes];
    auto* const first = static_cast<PfxShape*>(shapes.data);
    PfxUInt8 count = c.shapes_ == nullptr ? PfxUInt8(0) : c.num_shapes_;
    PfxUInt8 room = c.shapes_ == nullptr ? PfxUInt8(0) : c.max_shapes_;
    field(a, "shapes", count), field(a, "room", room);
    a.require(count <= room && room <= SCE_PFX_MAX_SHAPES, "a collidable has too many shapes");
    if (!a.good()) return;
    if (room == 0) {
      field(a, "own-shapes", c.num_shapes_);
      a.require(c.num_shapes_ <= 1, "a collidable has too many shapes");
      a.open("shape");
      io(a, all, c.own_shape_);
      a.close();
    }
    a.open("shape-ids");
    for (PfxUInt32 i = 0; i < room; ++i) {
      auto id = static_cast<PfxUInt32>(c.shape_ids_[i]);
      if constexpr (!A::kReads) id += static_cast<PfxUInt32>(c.shapes_ - first);
      a.number(id);
      // Places that no shape has taken may lie anywhere.
      a.require(id < shapes.count || i >= count, "a collidable has a shape that is not in the array");
      if constexpr (A::kReads) c.shape_ids_[i] = static_cast<PfxUInt16>(id);
    }
    a.close();
    if constexpr (A::kReads) {
      if (room > 0) c.shapes_ = first, c.num_shapes_ = count, c.max_shapes_ = room;
    }
    field(a, "center", c.center_), field(a, "half", c.half_);
  }

  template <class A>
  static void io(A& a, SerializeArrays all, PfxJoint& j) {
    using pfx::serial::field;
    field(a, "active", j.m_active), field(a, "num-constraints", j.m_numConstraints), field(a, "type", j.m_type);
    field(a, "body-a", j.m_rigidBodyIdA), field(a, "body-b", j.m_rigidBodyIdB);
    ioVector(a, "anchor-a", j.m_anchorA), ioVector(a, "anchor-b", j.m_anchorB);
    ioMatrix(a, "frame-a", j.m_frameA), ioMatrix(a, "frame-b", j.m_frameB);
    for (PfxJointConstraint& c : j.m_constraints) {
      a.open("axis");
      field(a, "lock", c.m_lock), field(a, "warm-starting", c.m_warmStarting);
      field(a, "lower", c.m_movableLowerLimit), field(a, "upper", c.m_movableUpperLimit);
      field(a, "bias", c.m_bias), field(a, "weight", c.m_weight), field(a, "damping", c.m_damping);
      field(a, "max-impulse", c.m_maxImpulse), field(a, "impulse", c.m_constraintRow.m_accumImpulse);
      a.close();
    }
    a.require(j.m_type < kPfxJointCount, "a joint is of an unknown kind");
    a.require(std::max(j.m_rigidBodyIdA, j.m_rigidBodyIdB) < all[kStates].count, "a joint names a body that is not there");
  }

  template <class A>
  static void io(A& a, SerializeArrays all, PfxBroadphasePair& p) {
    auto id_a = pfxGetRigidBodyIdA(p), id_b = pfxGetRigidBodyIdB(p);
    auto mask_a = pfxGetMotionMaskA(p), mask_b = pfxGetMotionMaskB(p);
    PfxUInt8 active = pfxGetActive(p);
    PfxUInt32 contact = pfxGetContactId(p), key = pfxGetKey(p);
    using pfx::serial::field;
    field(a, "body-a", id_a), field(a, "body-b", id_b), field(a, "motion-a", mask_a), field(a, "motion-b", mask_b);
    field(a, "active", active), field(a, "contact", contact), field(a, "key", key);
    a.require(std::max(id_a, id_b) < all[kStates].count, "a pair names a body that is not there");
    a.require(contact < all[kContacts].count, "a pair names a contact that is not there");
    if constexpr (A::kReads) {
      p = {};
      pfxSetRigidBodyIdA(p, id_a), pfxSetRigidBodyIdB(p, id_b);
      pfxSetMotionMaskA(p, mask_a), pfxSetMotionMaskB(p, mask_b);
      pfxSetActive(p, active != 0), pfxSetContactId(p, contact), pfxSetKey(p, key);
    }
  }

  template <class A>
  static void io(A& a, SerializeArrays, PfxContactManifold& m) {
    using pfx::serial::field;
    field(a, "body-a", m.body_a_), field(a, "body-b", m.body_b_);
    field(a, "duration", m.duration_), field(a, "friction", m.friction_), field(a, "points", m.num_points_);
    a.require(m.num_points_ <= SCE_PFX_NUMCONTACTS_PER_BODIES, "a contact has too many points");
    for (int i = 0; i < m.num_points_ && a.good(); ++i) {
      a.open("point");
      ioPoint(a, m.points_[i]);
      a.close();
    }
  }

 private:
  template <class A>
  static void ioPoint(A& a, PfxContactPoint& p) {
    using pfx::serial::field;
    field(a, "duration", p.m_duration), field(a, "shape-a", p.m_shapeIdA), field(a, "shape-b", p.m_shapeIdB);
    field(a, "feature", p.m_feature), field(a, "distance", p.m_distance);
    field(a, "point-a", p.m_localPointA), field(a, "point-b", p.m_localPointB);
    for (PfxConstraintRow& row : p.m_constraintRow) field(a, "normal", row.m_normal), field(a, "impulse", row.m_accumImpulse);
    PfxSubData& sub = p.m_subData;
    a.open("mesh");
    a.number(sub.m_type), a.number(sub.island_), a.number(sub.facet_), a.number(sub.s_), a.number(sub.t_), a.number(sub.user_data_);
    a.close();
  }

  template <class Mesh, class A>
  static void ioMesh(A& a, const pfx::serial::RecordArray& meshes, PfxShape& s) {
    auto* const first = static_cast<const Mesh*>(meshes.data);
    PfxUInt32 number = meshes.count;
    if constexpr (!A::kReads) number = static_cast<PfxUInt32>(static_cast<const Mesh*>(s.mesh_) - first);
    pfx::serial::field(a, "mesh", number);
    a.require(number < meshes.count, "a shape uses a mesh that is not in the array");
    if constexpr (A::kReads) s.mesh_ = first == nullptr ? nullptr : first + number;
  }
};

// Meshes: the engine's own records of them. Reading takes memory only for those that are kept.
inline void writeConvexMesh(pfx::serial::TextWriter& out, const PfxConvexMesh& m) {
  out.require(m.m_native != nullptr, "a convex mesh was not created");
  if (!out.good()) return;
  out.open("vertices");
  out.number(PfxUInt32(m.m_numVerts));
  for (PfxUInt32 i = 0; i < 3u * m.m_numVerts; ++i) out.number(m.m_verts[i]);
  out.close();
  out.open("triangles");
  out.number(PfxUInt32(m.m_numIndices) / 3u);
  for (PfxUInt32 i = 0; i < m.m_numIndices; ++i) out.number(m.m_indices[i]);
  out.close();
}
inline void readConvexMesh(pfx::serial::TextReader& in, PfxConvexMesh* mesh) {
  constexpr PfxUInt32 kMost = 3 * SCE_PFX_MAX_CONVEX_FACETS;  // vertices and indices
  std::vector<pfx::Vec3> vertices;
  std::vector<uint32_t> indices;
  PfxUInt32 count = 0;
  in.open("vertices");
  in.number(count);
  in.require(count <= kMost, "a convex mesh has too many vertices");
  for (PfxUInt32 i = 0; i < count && in.good(); ++i) {
    vertices.emplace_back();
    for (int k = 0; k < 3; ++k) in.number(vertices.back()[k]);
  }
  in.close();
  in.open("triangles");
  in.number(count);
  in.require(count <= SCE_PFX_MAX_CONVEX_FACETS, "a convex mesh has too many triangles");
  for (PfxUInt32 i = 0; i < 3 * count && in.good(); ++i) in.number(indices.emplace_back());
  in.close();
  pfx::ConvexMesh built;
  in.require(in.good() && pfx::checkConvexMesh(vertices, indices, built) == pfx::Error::Ok, "a convex mesh is not one");
  if (in.good() && mesh != nullptr)
    in.require(adoptConvexMesh(*mesh, std::move(built), vertices, indices) == SCE_PFX_OK, "no memory for a mesh");
}
inline void writeLargeTriMesh(pfx::serial::TextWriter& out, const PfxLargeTriMesh& m) {
  out.require(m.m_native != nullptr, "a large mesh was not created");
  if (out.good()) pfx::serial::io(out, static_cast<pfx::LargeMesh&>(*m.m_native));
}
inline void readLargeTriMesh(pfx::serial::TextReader& in, PfxLargeTriMesh* mesh) {
  pfx::LargeMesh built;
  pfx::serial::io(in, built);
  in.require(built.islands.size() <= SCE_PFX_MAX_LARGETRIMESH_ISLANDS, "a large mesh has too many islands");
  if (in.good() && mesh != nullptr) in.require(adoptLargeMesh(*mesh, built) == SCE_PFX_OK, "no memory for a mesh");
}

}  // namespace sce::PhysicsEffects
