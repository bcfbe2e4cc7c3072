// Pairs of bodies as the stages of the solver see them. Not part of the public headers.
#pragma once

#include <algorithm>

#include "compat/physics_effects/native.h"
#include "compat/physics_effects/solver.h"
#include "pfx/low_level/solver/impulse_joint.h"

namespace sce::PhysicsEffects {

constexpr uint32_t kBodyGrain = 64;  // bodies or pairs that one task takes

inline pfx::ImpulsePoint& impulses(PfxContactPoint& p) { return reinterpret_cast<pfx::ImpulsePoint&>(p.m_armA); }
inline pfx::ImpulseJointRow& impulses(PfxJointRow& row) { return reinterpret_cast<pfx::ImpulseJointRow&>(row); }
inline pfx::ImpulseJoint impulses(PfxJoint& joint) {
  PfxJointConstraint* c = joint.m_constraints;
  return {{&impulses(c[0].m_constraintRow), &impulses(c[1].m_constraintRow), &impulses(c[2].m_constraintRow),
           &impulses(c[3].m_constraintRow), &impulses(c[4].m_constraintRow), &impulses(c[5].m_constraintRow)},
          joint.m_coupling};
}
inline pfx::ImpulseBody& impulses(PfxSolverBody& b) { return reinterpret_cast<pfx::ImpulseBody&>(b); }

inline pfx::ImpulseBody& givingWay(PfxSolverBody& body, pfx::ImpulseBody& fixed) {
  return body.m_massInv > 0.0f ? impulses(body) : fixed;
}

// The two bodies of a pair as the rows see them. What does not give way is replaced, so that nothing is ever written to it:
// a body without mass by `fixed`, which is all zeros and stays so, and the partner of a OneWay body, which does not push, by
// a copy.
class SolverPair {
 public:
  SolverPair(PfxSolverBody& a, PfxSolverBody& b, pfx::ImpulseBody& fixed)
      : a_(&givingWay(a, fixed)), b_(&givingWay(b, fixed)) {
    // Two OneWay bodies form no pair, so that one copy will do.
    if (b.m_motionType == kPfxMotionTypeOneWay) [[unlikely]] a_ = &still(*a_);
    if (a.m_motionType == kPfxMotionTypeOneWay) [[unlikely]] b_ = &still(*b_);
  }
  SolverPair(const SolverPair&) = delete;
  operator pfx::ImpulsePair() const { return {*a_, *b_}; }

 private:
  pfx::ImpulseBody& still(const pfx::ImpulseBody& body) {
    copy_ = {};
    std::copy_n(body.dv, 3, copy_.dv);
    std::copy_n(body.dw, 3, copy_.dw);
    return copy_;
  }
  pfx::ImpulseBody copy_;
  pfx::ImpulseBody *a_, *b_;
};

// A list of pairs, and the contacts or joints that they name.
template <class Item>
struct PairList {
  const PfxConstraintPair* pairs;
  PfxUInt32 count;
  Item* items;
};
template <class Param>
PairList<PfxContactManifold> contactsOf(const Param& p) {
  return {p.contactPairs, p.numContactPairs, p.offsetContactManifolds};
}
template <class Param>
PairList<PfxJoint> jointsOf(const Param& p) {
  return {p.jointPairs, p.numJointPairs, p.offsetJoints};
}

// What every stage over pairs needs; an empty list needs nothing.
template <class Param, class Item>
PfxInt32 check(const Param& p, const PairList<Item>& list) {
  if (list.count == 0) return SCE_PFX_OK;
  if (list.items == nullptr || p.offsetRigidStates == nullptr || p.offsetSolverBodies == nullptr)
    return SCE_PFX_ERR_INVALID_VALUE;
  return checkPairs(list.pairs, list.count, p.numRigidBodies);
}

inline bool takesPart(const PfxConstraintPair& pair, const PfxRigidState* states) {
  return pfxGetActive(pair) && meetBy(kSolved, states[pfxGetRigidBodyIdA(pair)], states[pfxGetRigidBodyIdB(pair)]);
}

}  // namespace sce::PhysicsEffects
