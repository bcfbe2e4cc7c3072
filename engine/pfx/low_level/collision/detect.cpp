#include "pfx/low_level/collision/detect.h"

#include <algorithm>

#include "pfx/low_level/collision/recycle.h"

namespace pfx {
namespace {

constexpr uint32_t kPairGrain = 64;

bool isAwakeDynamic(const RigidState& s) { return isDynamic(s.motion_type) && !s.asleep; }

// Manifolds of all shapes of A against all shapes of B.
void collideAll(const Collidable& a, const Transform& pose_a, const Collidable& b, const Transform& pose_b, float margin,
                PairCache& cache, std::vector<ContactManifold>& out) {
  const auto shapes_a = a.shapes(), shapes_b = b.shapes();
  const bool single = shapes_a.size() == 1 && shapes_b.size() == 1;
  for (uint32_t i = 0; i < shapes_a.size(); ++i) {
    Aabb box_a;  // bounds of parts; a single pair has been through the broad phase
    if (!single) box_a = shapeAabb(shapes_a[i].geometry, pose_a * shapes_a[i].offset).grown(margin);
    for (uint32_t j = 0; j < shapes_b.size(); ++j) {
      if (!single && !box_a.overlaps(shapeAabb(shapes_b[j].geometry, pose_b * shapes_b[j].offset))) continue;
      ContactManifold m;
      collideShapes({shapes_a[i], pose_a, shapes_b[j], pose_b, margin, single ? &cache : nullptr}, m);
      if (m.num_points == 0) continue;
      // Features of different parts must not be mistaken for each other.
      if (!single)
        for (int k = 0; k < m.num_points; ++k) m.points[k].feature ^= (i * 64 + j + 1) * 0x9e3779b1u;
      m.local_normal = pose_a.orientation.conjugate() * m.normal;
      out.push_back(m);
    }
  }
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
  if (!isAwakeDynamic(a) && !isAwakeDynamic(b)) return;

  const ContactReach &ra = input.reach[pair.body_a], &rb = input.reach[pair.body_b];
  const float resting = std::min(ra.resting, rb.resting);
  const Transform pose_a = a.pose(), pose_b = b.pose(), b_in_a = relative(pose_a, pose_b);
  Contact& contact = contacts[pair.contact_id];
  const Collidable& shapes_b = input.collidables[pair.body_b];
  const float radius_b = (shapes_b.center.cwiseAbs() + shapes_b.half_extent).norm();
  if (contact.count > 0 && hardlyMoved(contact, b_in_a, radius_b, 0.5f * resting)) {
    measureAgain(contacts.manifolds(pair.contact_id), pose_a, pose_b);
    ++scratch.recycled;
    return;
  }

  scratch.found.clear();
  collideAll(input.collidables[pair.body_a], pose_a, input.collidables[pair.body_b], pose_b,
             resting + ra.travel + rb.travel, contact.cache, scratch.found);
  contact.relative = b_in_a;
  for (ContactManifold& m : scratch.found)
    for (int i = 0; i < m.num_points; ++i) inheritImpulses(m.points[i], contacts.manifolds(pair.contact_id));
  if (contacts.assignInPlace(pair.contact_id, scratch.found)) return;
  scratch.pending.push_back(
      {index, static_cast<uint32_t>(scratch.storage.size()), static_cast<uint32_t>(scratch.found.size())});
  scratch.storage.insert(scratch.storage.end(), scratch.found.begin(), scratch.found.end());
}

void CollisionDetector::detect(const DetectInput& input, ContactStore& contacts, TaskManager& tasks) {
  scratch_.resize(tasks.numWorkers());
  for (Scratch& s : scratch_) s.storage.clear(), s.pending.clear(), s.recycled = 0;
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
    for (uint32_t k = 0; k < scratch_[w].pending.size(); ++k) order_.push_back({scratch_[w].pending[k].pair, w});
  std::sort(order_.begin(), order_.end());
  for (const auto& [pair, worker] : order_) {
    const Scratch& s = scratch_[worker];
    const auto it = std::lower_bound(s.pending.begin(), s.pending.end(), pair,
                                     [](const Pending& p, uint32_t i) { return p.pair < i; });
    contacts.assign(input.pairs[pair].contact_id, std::span(s.storage).subspan(it->first, it->count));
  }
}

}  // namespace pfx
