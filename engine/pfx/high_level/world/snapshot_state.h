// Snapshots: the fields of what only a world knows; records.h and shape_records.h have the others.
#pragma once

#include "pfx/base_level/memory/containers.h"
#include "pfx/high_level/world/snapshot_archive.h"
#include "pfx/high_level/world/world_impl.h"
#include "pfx/util/serialize/records.h"
#include "pfx/util/serialize/shape_records.h"

namespace pfx::snapshot_format {

// Found by the archives, which live in this namespace.
using serial::enumField;
using serial::field;
using serial::io;
using serial::ioEnum;
using serial::ioList;
using serial::ioShape;
using serial::kNoMesh;

template <class A>
void io(A& a, JointLink& l) {
  io(a, l.body_a), io(a, l.body_b), io(a, l.exists), io(a, l.bodies_collide);
}

template <class A>
void io(A& a, ContactReach& r) {
  io(a, r.resting), io(a, r.travel), io(a, r.surface);
}

template <class A>
void io(A& a, BodyPose& k) {
  io(a, k.body), io(a, k.pose);
}

template <class A>
void io(A& a, JointId& id) {
  io(a, id.index), io(a, id.generation);
}

template <class A>
void io(A& a, BodyId& id) {
  io(a, id.index), io(a, id.generation);
}

template <class A>
void io(A& a, TouchingPair& t) {
  io(a, t.body_a), io(a, t.body_b), io(a, t.is_trigger);
}

// Meshes of a world by number.
struct KeptMeshes {
  Deque<ConvexMesh>& convex;
  Deque<LargeMesh>& large;

  uint32_t numberOf(const ConvexMesh* mesh) const { return numberIn(convex, mesh); }
  uint32_t numberOf(const LargeMesh* mesh) const { return numberIn(large, mesh); }
  bool find(uint32_t number, const ConvexMesh*& mesh) const { return findIn(convex, number, mesh); }
  bool find(uint32_t number, const LargeMesh*& mesh) const { return findIn(large, number, mesh); }

 private:
  template <class Mesh>
  static uint32_t numberIn(const Deque<Mesh>& kept, const Mesh* mesh) {
    const auto it = std::ranges::find_if(kept, [&](const Mesh& m) { return &m == mesh; });
    return it == kept.end() ? kNoMesh : static_cast<uint32_t>(it - kept.begin());
  }
  template <class Mesh>
  static bool findIn(const Deque<Mesh>& kept, uint32_t number, const Mesh*& mesh) {
    if (number >= kept.size()) return false;
    mesh = &kept[number];
    return true;
  }
};

template <class A>
void io(A& a, Surface& s) {
  io(a, s.torsional_resistance), io(a, s.velocity);
}

template <class A>
void io(A& a, PairCache& c) {
  io(a, c.b_in_a), io(a, c.axis), io(a, c.separation), io(a, c.radius_b), io(a, c.hint);
}

template <class A>
void io(A& a, ParticleStrand& s) {
  io(a, s.particles), io(a, s.lengths), io(a, s.compliance), io(a, s.impulses);
}
template <class A>
void io(A& a, DistanceConstraint& c) {
  io(a, c.a), io(a, c.b), io(a, c.length), io(a, c.compliance), io(a, c.impulse);
}
template <class A>
void io(A& a, AngleConstraint& c) {
  io(a, c.a), io(a, c.b), io(a, c.c), io(a, c.length_ab), io(a, c.length_bc), io(a, c.chord), io(a, c.compliance);
  io(a, c.impulse);
}
template <class A>
void io(A& a, VolumeConstraint& c) {
  io(a, c.a), io(a, c.b), io(a, c.c), io(a, c.d), io(a, c.volume), io(a, c.compliance), io(a, c.impulse);
}
template <class A>
void io(A& a, ParticleAnchor& c) {
  io(a, c.particle), io(a, c.body), io(a, c.local);
}
template <class A>
void io(A& a, ParticleSettings& s) {
  io(a, s.substeps), io(a, s.iterations), io(a, s.warm_start), io(a, s.radius), io(a, s.friction), io(a, s.damping);
  io(a, s.gravity_scale), io(a, s.filter_self), io(a, s.filter_target);
}
template <class A>
void io(A& a, ParticleDef& d) {
  io(a, d.name), io(a, d.settings), io(a, d.positions), io(a, d.velocities), io(a, d.masses), io(a, d.strands);
  io(a, d.distances), io(a, d.angles), io(a, d.volumes), io(a, d.anchors);
}

// A pair with its contact. The ids of contacts are given anew; nothing depends on them.
template <class A>
void ioPairs(A& a, Vector<Pair>& pairs, ContactStore& contacts) {
  constexpr size_t kMostManifolds = 1u << 15;  // of one pair
  Vector<ContactManifold> manifolds;
  ioList(a, pairs, [&](A& archive, Pair& p) {
    io(archive, p.body_a), io(archive, p.body_b), io(archive, p.flags);
    if constexpr (A::kReads) {
      p.contact_id = contacts.add();
    } else {
      const auto found = contacts.manifolds(p.contact_id);
      manifolds.assign(found.begin(), found.end());
    }
    io(archive, manifolds);
    if constexpr (A::kReads) {
      archive.require(manifolds.size() <= kMostManifolds, "a pair has too many manifolds");
      contacts.assign(p.contact_id, manifolds);
    }
    Contact& c = contacts[p.contact_id];
    io(archive, c.rolls), io(archive, c.reported_touching), io(archive, c.cache), io(archive, c.relative);
  });
}

}  // namespace pfx::snapshot_format
