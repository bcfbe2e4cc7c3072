#include "pfx/low_level/collision/detect.h"

#include <algorithm>
#include <bit>

#include "pfx/low_level/collision/body_pair.h"
#include "pfx/low_level/collision/recycle.h"

namespace pfx {
namespace {

constexpr uint32_t kPairGrain = 64;

// Of the distance that contacts reach ahead: how far a pair may move and keep its manifolds. The points of a body that
// rolls have to follow it at once. A point that lags behind makes the load push the body on, up to the speed at which
// it moves this far in a step.
constexpr float kKept = 0.5f, kKeptRolling = 5e-5f;

float radiusOf(const Collidable& c) { return (c.center.cwiseAbs() + c.half_extent).norm(); }

// How far the surface of a body may move in the step as seen from a second one, which turns about its own place.
float travelSeenFrom(const RigidState& body, float radius, const RigidState& frame, float dt) {
  const Vec3 carried = frame.linear_velocity + frame.angular_velocity.cross(body.position - frame.position);
  return dt * ((body.linear_velocity - carried).norm() + (body.angular_velocity - frame.angular_velocity).norm() * radius);
}

// The same of two bodies, seen from the larger one: bodies that move together reach no farther than those that rest.
float relativeTravel(const DetectInput& input, const Pair& pair) {
  const RigidState &a = input.states[pair.body_a], &b = input.states[pair.body_b];
  const float ra = radiusOf(input.collidables[pair.body_a]), rb = radiusOf(input.collidables[pair.body_b]);
  return ra < rb ? travelSeenFrom(a, ra, b, input.dt) : travelSeenFrom(b, rb, a, input.dt);
}

bool idsExist(const DetectInput& input, const ContactStore& contacts) {
  const size_t bodies = input.states.size();
  if (input.collidables.size() != bodies || input.reach.size() != bodies) return false;
  return std::ranges::all_of(input.pairs, [&](const Pair& p) {
    return p.body_a < bodies && p.body_b < bodies && p.contact_id < contacts.size();
  });
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
  const float tolerance = (contact.rolls ? kKeptRolling : kKept) * resting;
  if (contact.count > 0 && hardlyMoved(contact, b_in_a, {radiusOf(shapes_a), radiusOf(shapes_b)}, tolerance)) {
    measureAgain(contacts.manifolds(pair.contact_id), pose_a, pose_b);
    ++scratch.recycled;
    noteMesh(input, index, false, scratch);
    return;
  }

  scratch.found.clear();
  FoundManifolds found{scratch.found};
  const float travel = std::min(ra.travel + rb.travel, relativeTravel(input, pair) + ra.surface + rb.surface);
  collideBodies({shapes_a, shapes_b, pose_a, pose_b, resting + travel}, contact.cache, scratch.mesh, found);
  contact.relative = b_in_a;
  contact.rolls = found.rolls;
  noteMesh(input, index, found.leans, scratch);
  for (ContactManifold& m : scratch.found)
    for (int i = 0; i < m.num_points; ++i) inheritImpulses(m.points[i], contacts.manifolds(pair.contact_id));
  if (contacts.assignInPlace(pair.contact_id, scratch.found)) return;
  scratch.pending.push_back(
      {index, static_cast<uint32_t>(scratch.storage.size()), static_cast<uint32_t>(scratch.found.size())});
  scratch.storage.insert(scratch.storage.end(), scratch.found.begin(), scratch.found.end());
}

void CollisionDetector::noteMesh(const DetectInput& input, uint32_t index, bool leans, Scratch& scratch) {
  const Pair& pair = input.pairs[index];
  const bool mesh_a = hasMesh(input.collidables[pair.body_a]), mesh_b = hasMesh(input.collidables[pair.body_b]);
  if (mesh_a == mesh_b) return;
  scratch.mesh_pairs.push_back({mesh_a ? pair.body_b : pair.body_a, mesh_a ? pair.body_a : pair.body_b, index, leans});
}

// Any worker may get the pairs that another one had last time, so all have room for what all of them needed.
void CollisionDetector::prepareScratch(uint32_t num_workers) {
  size_t most_found = 0, all_stored = 0, all_pending = 0, all_mesh_pairs = 0;
  scratch_.resize(num_workers);
  for (const Scratch& s : scratch_) {
    most_found = std::max(most_found, s.found.capacity());
    all_stored += s.storage.size();
    all_pending += s.pending.size();
    all_mesh_pairs += s.mesh_pairs.size();
  }
  for (Scratch& s : scratch_) {
    s.storage.clear(), s.pending.clear(), s.mesh_pairs.clear(), s.recycled = 0;
    s.found.reserve(most_found);
    s.storage.reserve(std::bit_ceil(all_stored));
    s.pending.reserve(std::bit_ceil(all_pending));
    s.mesh_pairs.reserve(std::bit_ceil(all_mesh_pairs));
  }
}

Error CollisionDetector::detect(const DetectInput& input, ContactStore& contacts, TaskManager& tasks) {
  if (!idsExist(input, contacts)) return Error::OutOfRange;
  prepareScratch(static_cast<uint32_t>(tasks.numWorkers()));
  tasks.parallelFor(static_cast<uint32_t>(input.pairs.size()), kPairGrain, [&](TaskRange r) {
    for (uint32_t i = r.begin; i < r.end; ++i) detectPair(input, i, contacts, scratch_[r.worker]);
  });
  num_recycled_ = 0;
  for (const Scratch& s : scratch_) num_recycled_ += s.recycled;
  assignPending(input, contacts);
  mesh_pairs_.clear();
  for (const Scratch& s : scratch_) mesh_pairs_.insert(mesh_pairs_.end(), s.mesh_pairs.begin(), s.mesh_pairs.end());
  dropGhostContacts({input.states, input.collidables, input.pairs}, mesh_pairs_, contacts);
  return Error::Ok;
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
