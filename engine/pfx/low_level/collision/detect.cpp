#include "pfx/low_level/collision/detect.h"

#include <algorithm>
#include <bit>

#include "pfx/low_level/collision/recycle.h"

namespace pfx {
namespace {

constexpr uint32_t kPairGrain = 64;

bool isMesh(const Shape& shape) { return shape.type() == ShapeType::LargeMesh; }

float radiusOf(const Collidable& c) { return (c.center.cwiseAbs() + c.half_extent).norm(); }

// Two bodies as the narrow phase sees them.
struct BodyPair {
  const Collidable &a, &b;
  const Transform &pose_a, &pose_b;
  float margin;
};

// Appends the manifolds of one shape of A and one of B.
void collideOne(const CollideInput& input, MeshContactScratch& mesh_scratch,
                std::vector<ContactManifold>& out) {
  if (isMesh(input.shape_a) || isMesh(input.shape_b)) {
    collideMesh(input, mesh_scratch, out);
    return;
  }
  ContactManifold m;
  if (collideShapes(input, m) > 0) out.push_back(m);
}

// Manifolds of compounds: all shapes of A against all shapes of B whose bounds meet.
void collideParts(const BodyPair& p, MeshContactScratch& mesh_scratch, std::vector<ContactManifold>& out) {
  const auto shapes_a = p.a.shapes(), shapes_b = p.b.shapes();
  for (uint32_t i = 0; i < shapes_a.size(); ++i) {
    const Aabb box_a = shapeAabb(shapes_a[i].geometry, p.pose_a * shapes_a[i].offset).grown(p.margin);
    for (uint32_t j = 0; j < shapes_b.size(); ++j) {
      if (!box_a.overlaps(shapeAabb(shapes_b[j].geometry, p.pose_b * shapes_b[j].offset))) continue;
      const size_t first = out.size();
      collideOne({shapes_a[i], p.pose_a, shapes_b[j], p.pose_b, p.margin, nullptr}, mesh_scratch, out);
      // Features of different parts must not be mistaken for each other.
      for (ContactManifold& m : std::span(out).subspan(first))
        for (int k = 0; k < m.num_points; ++k) m.points[k].feature ^= (i * 64 + j + 1) * 0x9e3779b1u;
    }
  }
}

void collideBodies(const BodyPair& p, PairCache& cache, MeshContactScratch& mesh_scratch,
                   std::vector<ContactManifold>& out) {
  const auto shapes_a = p.a.shapes(), shapes_b = p.b.shapes();
  if (shapes_a.size() == 1 && shapes_b.size() == 1)
    collideOne({shapes_a[0], p.pose_a, shapes_b[0], p.pose_b, p.margin, &cache}, mesh_scratch, out);
  else
    collideParts(p, mesh_scratch, out);
  for (ContactManifold& m : out) m.local_normal = p.pose_a.orientation.conjugate() * m.normal;
}

void inheritImpulses(ContactPoint& point, std::span<const ContactManifold> old) {
  for (const ContactManifold& m : old) {
    for (int i = 0; i < m.num_points; ++i) {
      if (m.points[i].feature != point.feature) continue;
      point.normal_impulse = m.points[i].normal_impulse;
      point.friction_impulse = m.points[i].friction_impulse;
      return;
    }
  }
}

}  // namespace

void CollisionDetector::detectPair(const DetectInput& input, uint32_t index, ContactStore& contacts,
                                   Scratch& scratch) const {
  const Pair& pair = input.pairs[index];
  const RigidState &a = input.states[pair.body_a], &b = input.states[pair.body_b];
  if (!moves(a) && !moves(b)) return;

  const ContactReach &ra = input.reach[pair.body_a], &rb = input.reach[pair.body_b];
  const float resting = std::min(ra.resting, rb.resting);
  const Transform pose_a = a.pose(), pose_b = b.pose(), b_in_a = relative(pose_a, pose_b);
  Contact& contact = contacts[pair.contact_id];
  const Collidable &shapes_a = input.collidables[pair.body_a], &shapes_b = input.collidables[pair.body_b];
  if (contact.count > 0 &&
      hardlyMoved(contact, b_in_a, {radiusOf(shapes_a), radiusOf(shapes_b)}, 0.5f * resting)) {
    measureAgain(contacts.manifolds(pair.contact_id), pose_a, pose_b);
    ++scratch.recycled;
    return;
  }

  scratch.found.clear();
  collideBodies({shapes_a, shapes_b, pose_a, pose_b, resting + ra.travel + rb.travel}, contact.cache,
                scratch.mesh, scratch.found);
  contact.relative = b_in_a;
  for (ContactManifold& m : scratch.found)
    for (int i = 0; i < m.num_points; ++i) inheritImpulses(m.points[i], contacts.manifolds(pair.contact_id));
  if (contacts.assignInPlace(pair.contact_id, scratch.found)) return;
  scratch.pending.push_back(
      {index, static_cast<uint32_t>(scratch.storage.size()), static_cast<uint32_t>(scratch.found.size())});
  scratch.storage.insert(scratch.storage.end(), scratch.found.begin(), scratch.found.end());
}

// Any worker may get the pairs that another one had last time, so all have room for what all of them needed.
void CollisionDetector::prepareScratch(uint32_t num_workers) {
  size_t most_found = 0, all_stored = 0, all_pending = 0;
  scratch_.resize(num_workers);
  for (const Scratch& s : scratch_) {
    most_found = std::max(most_found, s.found.capacity());
    all_stored += s.storage.size();
    all_pending += s.pending.size();
  }
  for (Scratch& s : scratch_) {
    s.storage.clear(), s.pending.clear(), s.recycled = 0;
    s.found.reserve(most_found);
    s.storage.reserve(std::bit_ceil(all_stored));
    s.pending.reserve(std::bit_ceil(all_pending));
  }
}

void CollisionDetector::detect(const DetectInput& input, ContactStore& contacts, TaskManager& tasks) {
  prepareScratch(static_cast<uint32_t>(tasks.numWorkers()));
  tasks.parallelFor(static_cast<uint32_t>(input.pairs.size()), kPairGrain, [&](TaskRange r) {
    for (uint32_t i = r.begin; i < r.end; ++i) detectPair(input, i, contacts, scratch_[r.worker]);
  });
  num_recycled_ = 0;
  for (const Scratch& s : scratch_) num_recycled_ += s.recycled;
  assignPending(input, contacts);
}

// In the order of the pairs, so that blocks do not depend on who found what.
void CollisionDetector::assignPending(const DetectInput& input, ContactStore& contacts) {
  order_.clear();
  for (uint32_t w = 0; w < scratch_.size(); ++w)
    for (uint32_t k = 0; k < scratch_[w].pending.size(); ++k)
      order_.push_back({scratch_[w].pending[k].pair, w});
  std::sort(order_.begin(), order_.end());
  for (const auto& [pair, worker] : order_) {
    const Scratch& s = scratch_[worker];
    const auto it = std::lower_bound(s.pending.begin(), s.pending.end(), pair,
                                     [](const Pending& p, uint32_t i) { return p.pair < i; });
    contacts.assign(input.pairs[pair].contact_id, std::span(s.storage).subspan(it->first, it->count));
  }
}

}  // namespace pfx
