// Contact manifolds, and the stage that fills them.
#pragma once

#include "broadphase.h"

#define SCE_PFX_CONTACT_MARGIN_ 0.01f  // m, contacts are kept up to this gap

namespace sce {
namespace PhysicsEffects {

// Where on a large mesh a contact or a hit lies.
class PfxSubData {
 public:
  // Kind of the data; the other numbers mean something for MESH_INFO only.
  enum { NONE = 0, MESH_INFO = 1 };
  // NONE or MESH_INFO.
  PfxUInt8 m_type = NONE;
  // Which triangle: its island, its number there, and what the application gave it.
  PfxUInt16 getIslandId() const { return island_; }
  PfxUInt16 getFacetId() const { return facet_; }  // in the island
  PfxUInt32 getUserData() const { return user_data_; }
  // The point is v0 + s (v1 - v0) + t (v2 - v0), held as 16-bit fractions.
  PfxFloat getFacetLocalS() const { return s_ / 65535.0f; }
  PfxFloat getFacetLocalT() const { return t_ / 65535.0f; }
  void setIslandId(PfxUInt16 id) { island_ = id; }
  void setFacetId(PfxUInt16 id) { facet_ = id; }
  void setUserData(PfxUInt32 data) { user_data_ = data; }
  void setFacetLocalS(PfxFloat s) { s_ = fraction(s); }
  void setFacetLocalT(PfxFloat t) { t_ = fraction(t); }

  // 0 .. 1 as 16 bits.
  static PfxUInt16 fraction(PfxFloat x) { return static_cast<PfxUInt16>(SCE_PFX_CLAMP(x, 0.0f, 1.0f) * 65535.0f + 0.5f); }
  // As stored.
  PfxUInt16 island_ = 0, facet_ = 0;
  PfxUInt16 s_ = 0, t_ = 0;
  PfxUInt32 user_data_ = 0;
};

// One row of the solver: velocity wanted along a direction, and the impulse gathered so far.
struct PfxConstraintRow {
  // What the row asks for: N s for m_rhs (the impulse that would reach the wanted velocity) and the limits, kg for m_jacDiagInv.
  PfxFloat m_normal[3];  // unit, world
  PfxFloat m_rhs;
  PfxFloat m_jacDiagInv;
  PfxFloat m_lowerLimit;
  PfxFloat m_upperLimit;
  PfxFloat m_accumImpulse;  // N s
};

// A point where two bodies touch or nearly do.
struct PfxContactPoint {
  // Where the point lies, which shapes of the bodies meet there, and the rows of the solver.
  PfxUInt8 m_duration;  // steps that the point has been kept, up to 255
  PfxUInt8 m_shapeIdA;
  PfxUInt8 m_shapeIdB;
  PfxUInt32 m_feature;   // names the pair of features; equal features match from step to step
  PfxSubData m_subData;
  union {
    PfxFloat m_distance;  // m along the normal; negative: overlap
    PfxFloat m_distance1;
  };
  PfxFloat m_localPointA[3];            // m, in the frame of body A
  PfxFloat m_localPointB[3];            // m, in the frame of body B
  // Filled by the solver: levers (m, world) from the centres to the point; what takes back overlap, N s.
  PfxFloat m_armA[3];                   // m, world, from the centre to the point
  PfxFloat m_armB[3];
  PfxConstraintRow m_constraintRow[3];  // the normal, from B to A, and two tangents
  PfxFloat m_pushRhs, m_push[3];        // N s, to take back overlap: filled by the solver

  // A point without place, feature and impulse.
  PfxContactPoint() { reset(); }
  void reset();
  // Unit, world axes, from B to A.
  PfxVector3 getNormal() const { return pfxReadVector3(m_constraintRow[0].m_normal); }
};

// What is known of the contact of two bodies: up to four points.
class PfxContactManifold {
 public:
  // Between two bodies, without points.
  PfxContactManifold() { reset(0, 0); }
  void reset(PfxUInt16 rigidBodyIdA, PfxUInt16 rigidBodyIdB);

  // The bodies, the points (0 .. 3), and the friction of the two surfaces together.
  PfxUInt16 getRigidBodyIdA() const { return body_a_; }
  PfxUInt16 getRigidBodyIdB() const { return body_b_; }
  int getNumContacts() const { return num_points_; }
  PfxContactPoint& getContactPoint(int i) { return points_[i]; }
  const PfxContactPoint& getContactPoint(int i) const { return points_[i]; }
  PfxFloat getCompositeFriction() const { return friction_; }
  void setCompositeFriction(PfxFloat friction) { friction_ = friction; }
  PfxUInt16 getDuration() const { return duration_; }  // steps with at least one point

  // Points in the frames of their bodies, normal in the world from B to A. A fifth point drives one out: the deepest is
  // kept, and of the others those that span the largest area.
  void addContactPoint(PfxFloat distance, const PfxVector3& normal, const PfxPoint3& pointA, const PfxPoint3& pointB,
                       const PfxSubData& subData = PfxSubData());
  void addContactPoint(const PfxContactPoint& point);
  void removeContactPoints() { num_points_ = 0; }
  void removeContactPoint(int i) { points_[i] = points_[--num_points_]; }
  // Measures the points again at new poses and removes those that have separated or slid by 1 cm.
  void refresh(const PfxVector3& positionA, const PfxQuat& orientationA, const PfxVector3& positionB,
               const PfxQuat& orientationB);
  void countStep() { duration_ = static_cast<PfxUInt16>(num_points_ == 0 ? 0 : SCE_PFX_MIN(duration_ + 1, 0xffff)); }

 private:
  friend struct PfxSerializeAccess;
  PfxUInt16 body_a_, body_b_;
  PfxUInt16 duration_;
  PfxUInt16 num_points_;
  PfxFloat friction_;
  PfxContactPoint points_[SCE_PFX_NUMCONTACTS_PER_BODIES];
};

// Pairs, and the arrays that their ids lead into.
struct PfxDetectCollisionParam {
  // Arrays of the application; numRigidBodies bounds the ids in the pairs, 0: not known.
  PfxConstraintPair* contactPairs = nullptr;  // with contact ids
  PfxUInt32 numContactPairs = 0;
  PfxContactManifold* offsetContactManifolds = nullptr;
  PfxRigidState* offsetRigidStates = nullptr;
  PfxCollidable* offsetCollidables = nullptr;
  SCE_PFX_NUM_RIGID_BODIES_;
};
// Pairs, and the arrays that their ids lead into.
struct PfxRefreshContactsParam {
  // Arrays of the application; numRigidBodies bounds the ids in the pairs, 0: not known.
  PfxConstraintPair* contactPairs = nullptr;
  PfxUInt32 numContactPairs = 0;
  PfxContactManifold* offsetContactManifolds = nullptr;
  PfxRigidState* offsetRigidStates = nullptr;
  SCE_PFX_NUM_RIGID_BODIES_;
};
// Finds the contacts of all active pairs whose motion types admit it. SCE_PFX_ERR_INVALID_VALUE: NULL;
// SCE_PFX_ERR_OUT_OF_RANGE: a pair names a body that is not there.
PfxInt32 pfxDetectCollision(PfxDetectCollisionParam& param, PfxTaskManager* taskManager = nullptr);
// Removes contact points that have separated.
PfxInt32 pfxRefreshContacts(PfxRefreshContactsParam& param, PfxTaskManager* taskManager = nullptr);

}  // namespace PhysicsEffects
}  // namespace sce
