// Sleep: islands at rest leave the step, and come back whole when something touches one of their bodies.
//
// The bodies of a sleeping island form a ring (World::Impl::next_sleeper), and their pairs wait in a list of
// their own, with contacts and impulses, so that a woken stack goes on as if it had never slept.
#include <algorithm>

#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx {

void World::Impl::wake(uint32_t body) {
  RigidState& first = store.states[body];
  first.sleep_count = 0;
  if (!first.asleep) return;
  uint32_t i = body;
  do {
    store.states[i].asleep = false;
    store.states[i].sleep_count = 0;
    if (def.report_events) events.next_woke.push_back({i, store.generations[i]});
    i = next_sleeper[i];
  } while (i != body);
  active_changed = true;
  forgetCounts();
  has_woken = true;
}

void World::Impl::wakeNeighbours(uint32_t body) {
  for (const auto* list : {&pairs, &sleeping_pairs}) {
    for (const Pair& p : *list) {
      if (p.body_a == body) wake(p.body_b);
      if (p.body_b == body) wake(p.body_a);
    }
  }
  for (const JointLink& j : joint_store.links) {
    if (!j.exists) continue;
    if (j.body_a == body) wake(j.body_b);
    if (j.body_b == body) wake(j.body_a);
  }
  revivePairs();
}

// Brings the pairs of woken bodies back among the active ones. A pair that was found anew meanwhile is
// dropped.
void World::Impl::revivePairs() {
  if (!has_woken) return;
  has_woken = false;
  const auto is_awake = [&](uint32_t i) { return moves(store.states[i]); };
  next_pairs.clear();
  std::erase_if(sleeping_pairs, [&](const Pair& p) {
    if (!is_awake(p.body_a) && !is_awake(p.body_b)) return false;
    next_pairs.push_back(p);
    return true;
  });
  const auto by_key = [](const Pair& a, const Pair& b) { return a.key() < b.key(); };
  std::erase_if(next_pairs, [&](const Pair& p) {
    if (!std::binary_search(pairs.begin(), pairs.end(), p, by_key)) return false;
    contacts.remove(p.contact_id);
    return true;
  });
  pairs.insert(pairs.end(), next_pairs.begin(), next_pairs.end());
  std::sort(pairs.begin(), pairs.end(), by_key);  // keys are unique; a merge in place would allocate
}

namespace stage {
namespace {

void layDown(World::Impl& w, std::span<const uint32_t> bodies) {
  w.next_sleeper.resize(w.store.states.size());
  for (size_t k = 0; k < bodies.size(); ++k) {
    RigidState& s = w.store.states[bodies[k]];
    s.asleep = true;
    s.linear_velocity = s.angular_velocity = Vec3::Zero();
    w.next_sleeper[bodies[k]] = bodies[(k + 1) % bodies.size()];
    if (w.def.report_events) w.events.next_fell_asleep.push_back({bodies[k], w.store.generations[bodies[k]]});
  }
  w.active_changed = true;
}

// Sets the pairs aside that no body which moves is part of.
void setPairsAside(World::Impl& w) {
  std::erase_if(w.pairs, [&](const Pair& p) {
    if (moves(w.store.states[p.body_a]) || moves(w.store.states[p.body_b])) return false;
    w.sleeping_pairs.push_back(p);
    return true;
  });
  std::ranges::sort(w.sleeping_pairs, {}, &Pair::key);
}

}  // namespace

void wakeTouched(World::Impl& w) {
  for (const Pair& p : w.pairs) {
    const RigidState &a = w.store.states[p.body_a], &b = w.store.states[p.body_b];
    if (!a.asleep && !b.asleep) continue;
    if (!solvesConstraint(a.motion_type, b.motion_type) || w.contacts.manifolds(p.contact_id).empty())
      continue;
    w.wake(p.body_a);
    w.wake(p.body_b);
  }
  w.revivePairs();
  w.refreshActive();
}

void putToSleep(World::Impl& w) {
  w.linkIslands();
  const float limit2 = w.def.sleep_velocity * w.def.sleep_velocity;
  for (uint32_t k = 0; k < w.islands.size(); ++k) {
    uint32_t least = 0xffffffffu;
    for (uint32_t i : w.islands.bodies(k)) {
      RigidState& s = w.store.states[i];
      const bool slow = s.linear_velocity.squaredNorm() < limit2 && s.angular_velocity.squaredNorm() < limit2;
      s.sleep_count = slow && s.can_sleep ? s.sleep_count + 1 : 0;
      least = std::min(least, s.sleep_count);
    }
    if (least > w.def.sleep_steps) layDown(w, w.islands.bodies(k));
  }
  if (w.active_changed) setPairsAside(w);
}

}  // namespace stage
}  // namespace pfx
