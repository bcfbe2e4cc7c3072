// Solving: iterations over joints and contacts, one pair after the other.
#include <algorithm>
#include <span>

#include "compat/physics_effects/solver_pair.h"

namespace sce::PhysicsEffects {
namespace {

// The face between two bodies settles before what it passes on changes the next one. One visit an iteration leaves columns
// of boxes swaying that stand with two.
constexpr int kContactVisits = 2;

// Pushes start from nothing in each step, so they need more.
constexpr PfxUInt32 kPushVisits = 2;

// A pair to solve, looked up once for all iterations.
template <class Item>
struct Visit {
  PfxSolverBody *a, *b;
  Item* item;
  bool one_way;  // one of the bodies is OneWay
};

// The pairs to solve, in order.
struct Selection {
  std::span<const Visit<PfxContactManifold>> contacts;
  std::span<const Visit<PfxJoint>> joints;
};

template <class Item, class Fn>
void forEachPair(std::span<const Visit<Item>> chosen, Fn&& fn) {
  pfx::ImpulseBody fixed = {};
  for (const Visit<Item>& v : chosen) {
    if (v.one_way) fn(SolverPair(*v.a, *v.b, fixed), *v.item);
    else fn(pfx::ImpulsePair{givingWay(*v.a, fixed), givingWay(*v.b, fixed)}, *v.item);
  }
}

void warmStartContact(pfx::ImpulsePair bodies, PfxContactManifold& manifold) {
  for (int k = 0; k < manifold.getNumContacts(); ++k) pfx::warmStart(bodies, impulses(manifold.getContactPoint(k)));
}
void warmStartJoint(pfx::ImpulsePair bodies, PfxJoint& joint) { pfx::warmStart(bodies, impulses(joint)); }
void solveContact(pfx::ImpulsePair bodies, PfxContactManifold& manifold) {
  const PfxFloat friction = manifold.getCompositeFriction();
  PfxContactPoint *const first = &manifold.getContactPoint(0), *const end = first + manifold.getNumContacts();
  for (int visit = 0; visit < kContactVisits; ++visit)
    for (PfxContactPoint* p = first; p != end; ++p) pfx::solveImpulses(bodies, friction, impulses(*p));
}
void solveJoint(pfx::ImpulsePair bodies, PfxJoint& joint) { pfx::solveImpulses(bodies, impulses(joint)); }

// Sweeps over the pushes: none without overlap, one for what is taken back slowly.
PfxUInt32 pushSweeps(const PfxSolveConstraintsParam& p, std::span<const Visit<PfxContactManifold>> contacts) {
  PfxUInt32 sweeps = 0;
  for (const Visit<PfxContactManifold>& v : contacts) {
    for (int k = 0; k < v.item->getNumContacts(); ++k) {
      const PfxContactPoint& point = v.item->getContactPoint(k);
      if (point.m_distance < -pfx::kSoftOverlap) return kPushVisits * p.iteration;
      if (point.m_pushRhs > 0.0f) sweeps = 1;
    }
  }
  return sweeps;
}
void solvePush(pfx::ImpulsePair bodies, PfxContactManifold& manifold) {
  const PfxFloat friction = manifold.getCompositeFriction();
  for (int k = 0; k < manifold.getNumContacts(); ++k) pfx::solvePush(bodies, friction, impulses(manifold.getContactPoint(k)));
}

void solve(const PfxSolveConstraintsParam& p, const Selection& s, PfxUInt32 push_sweeps) {
  forEachPair(s.joints, warmStartJoint);
  forEachPair(s.contacts, warmStartContact);
  for (PfxUInt32 i = 0; i < p.iteration; ++i) {
    forEachPair(s.joints, solveJoint);
    forEachPair(s.contacts, solveContact);
  }
  for (PfxUInt32 i = 0; i < push_sweeps; ++i) forEachPair(s.contacts, solvePush);
}

template <class Item>
Visit<Item> visitOf(const PfxSolveConstraintsParam& p, const PairList<Item>& list, PfxUInt32 i) {
  const PfxConstraintPair& pair = list.pairs[i];
  PfxSolverBody &a = p.offsetSolverBodies[pfxGetRigidBodyIdA(pair)], &b = p.offsetSolverBodies[pfxGetRigidBodyIdB(pair)];
  return {&a, &b, &list.items[pfxGetContactId(pair)],
          a.m_motionType == kPfxMotionTypeOneWay || b.m_motionType == kPfxMotionTypeOneWay};
}

// The pairs that take part, in groups that share no body which gives way. Groups can be solved side by side, and each pair
// meets the same numbers as when all are solved in one row. Lies in the work buffer.
class Groups {
 public:
  static PfxUInt32 bytes(PfxUInt32 bodies, PfxUInt32 contacts, PfxUInt32 joints) {
    return SCE_PFX_BYTES_ALIGN16(static_cast<PfxUInt32>(sizeof(Visit<PfxContactManifold>) * contacts + sizeof(Visit<PfxJoint>) * joints +
                                                        sizeof(PfxUInt32) * 3 * (bodies + 1)));
  }

  Groups(const PfxSolveConstraintsParam& p)
      : num_bodies_(p.numRigidBodies), contacts_(static_cast<Visit<PfxContactManifold>*>(p.workBuff)),
        joints_(reinterpret_cast<Visit<PfxJoint>*>(contacts_ + p.numContactPairs)),
        parent_(reinterpret_cast<PfxUInt32*>(joints_ + p.numJointPairs)), first_contact_(parent_ + num_bodies_ + 1),
        first_joint_(first_contact_ + num_bodies_ + 1) {}

  // All pairs in one group.
  Selection all(const PfxSolveConstraintsParam& p) {
    return {choose(p, contactsOf(p), contacts_), choose(p, jointsOf(p), joints_)};
  }

  // Returns the number of groups: one for each body at most, many of them empty.
  PfxUInt32 split(const PfxSolveConstraintsParam& p) {
    for (PfxUInt32 i = 0; i < num_bodies_; ++i) parent_[i] = i;
    connect(p, contactsOf(p));
    connect(p, jointsOf(p));
    distribute(p, contactsOf(p), first_contact_, contacts_);
    distribute(p, jointsOf(p), first_joint_, joints_);
    return num_bodies_;
  }
  std::span<const Visit<PfxContactManifold>> contactsOfAll() const { return {contacts_, first_contact_[num_bodies_]}; }
  Selection group(PfxUInt32 i) const {
    return {{contacts_ + first_contact_[i], contacts_ + first_contact_[i + 1]}, {joints_ + first_joint_[i], joints_ + first_joint_[i + 1]}};
  }

 private:
  PfxUInt32 root(PfxUInt32 i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  static bool gives(const PfxSolveConstraintsParam& p, PfxUInt32 body) { return p.offsetSolverBodies[body].m_massInv > 0.0f; }
  // The body whose group a pair belongs to.
  static PfxUInt32 ownerOf(const PfxSolveConstraintsParam& p, const PfxConstraintPair& pair) {
    const PfxUInt32 a = pfxGetRigidBodyIdA(pair);
    return gives(p, a) ? a : pfxGetRigidBodyIdB(pair);
  }

  template <class Item>
  static std::span<const Visit<Item>> choose(const PfxSolveConstraintsParam& p, const PairList<Item>& list, Visit<Item>* out) {
    PfxUInt32 n = 0;
    for (PfxUInt32 i = 0; i < list.count; ++i)
      if (takesPart(list.pairs[i], p.offsetRigidStates)) out[n++] = visitOf(p, list, i);
    return {out, n};
  }
  template <class Item>
  void connect(const PfxSolveConstraintsParam& p, const PairList<Item>& list) {
    for (PfxUInt32 i = 0; i < list.count; ++i) {
      const PfxUInt32 a = pfxGetRigidBodyIdA(list.pairs[i]), b = pfxGetRigidBodyIdB(list.pairs[i]);
      if (!takesPart(list.pairs[i], p.offsetRigidStates) || !gives(p, a) || !gives(p, b)) continue;
      const PfxUInt32 ra = root(a), rb = root(b);
      parent_[std::max(ra, rb)] = std::min(ra, rb);
    }
  }
  // Counting sort by group; the order within a group stays.
  template <class Item>
  void distribute(const PfxSolveConstraintsParam& p, const PairList<Item>& list, PfxUInt32* first, Visit<Item>* out) {
    std::fill_n(first, num_bodies_ + 1, 0u);
    const auto each = [&](auto&& fn) {
      for (PfxUInt32 i = 0; i < list.count; ++i)
        if (takesPart(list.pairs[i], p.offsetRigidStates)) fn(root(ownerOf(p, list.pairs[i])), i);
    };
    each([&](PfxUInt32 group, PfxUInt32) { ++first[group + 1]; });
    for (PfxUInt32 g = 0; g < num_bodies_; ++g) first[g + 1] += first[g];
    each([&](PfxUInt32 group, PfxUInt32 i) { out[first[group]++] = visitOf(p, list, i); });
    for (PfxUInt32 g = num_bodies_; g > 0; --g) first[g] = first[g - 1];  // each had moved on to the start of the next
    first[0] = 0;
  }

  PfxUInt32 num_bodies_;
  Visit<PfxContactManifold>* contacts_;
  Visit<PfxJoint>* joints_;
  PfxUInt32 *parent_, *first_contact_, *first_joint_;
};

void addChanges(const PfxSolveConstraintsParam& p, PfxUInt32 i) {
  const PfxSolverBody& body = p.offsetSolverBodies[i];
  if (!(body.m_massInv > 0.0f)) return;
  PfxRigidState& state = p.offsetRigidStates[i];
  const PfxVector3 push = pfxReadVector3(body.m_pushLinearVelocity), push_turn = pfxReadVector3(body.m_pushAngularVelocity);
  state.setLinearVelocity(state.getLinearVelocity() + pfxReadVector3(body.m_deltaLinearVelocity) + push, push);
  state.setAngularVelocity(state.getAngularVelocity() + pfxReadVector3(body.m_deltaAngularVelocity) + push_turn, push_turn);
}

}  // namespace

PfxUInt32 pfxGetWorkBytesOfSolveConstraints(PfxUInt32 numRigidBodies, PfxUInt32 numContactPairs, PfxUInt32 numJointPairs, PfxUInt32) {
  return Groups::bytes(numRigidBodies, numContactPairs, numJointPairs);
}

PfxInt32 pfxSolveConstraints(PfxSolveConstraintsParam& p, PfxTaskManager* taskManager) {
  if (p.workBuff == nullptr || p.iteration == 0) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(p.workBuff)) return SCE_PFX_ERR_INVALID_ALIGN;
  if (p.workBytes < Groups::bytes(p.numRigidBodies, p.numContactPairs, p.numJointPairs)) return SCE_PFX_ERR_OUT_OF_BUFFER;
  if (p.numRigidBodies == 0 && p.numContactPairs + p.numJointPairs > 0) return SCE_PFX_ERR_OUT_OF_RANGE;
  if (p.numRigidBodies > 0 && (p.offsetRigidStates == nullptr || p.offsetSolverBodies == nullptr)) return SCE_PFX_ERR_INVALID_VALUE;
  if (const PfxInt32 e = check(p, contactsOf(p)); e != SCE_PFX_OK) return e;
  if (const PfxInt32 e = check(p, jointsOf(p)); e != SCE_PFX_OK) return e;

  pfx::TaskManager* pool = poolOf(taskManager);
  Groups groups(p);
  if (pfx::numWorkers(pool) == 1) {
    const Selection all = groups.all(p);
    solve(p, all, pushSweeps(p, all.contacts));
  } else {
    const PfxUInt32 count = groups.split(p), push_sweeps = pushSweeps(p, groups.contactsOfAll());
    pfx::parallelFor(pool, count, kBodyGrain, [&](pfx::TaskRange range) {
      for (uint32_t i = range.begin; i < range.end; ++i) solve(p, groups.group(i), push_sweeps);
    });
  }
  pfx::parallelFor(pool, p.numRigidBodies, kBodyGrain, [&](pfx::TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) addChanges(p, i);
  });
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects
