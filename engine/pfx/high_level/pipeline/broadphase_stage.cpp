// Broad phase of a world: bounds with margins, pairs, and the contacts that belong to them.
#include <algorithm>

#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx::stage {
namespace {

// Share of a body's smallest half extent that contacts reach ahead of touching.
constexpr float kRestingMargin = 0.02f;
constexpr uint32_t kProxyGrain = 256;

ContactReach reachOf(const World::Impl& w, uint32_t i) {
  const RigidState& s = w.store.states[i];
  const float size = w.store.size[i];
  const float speed = s.linear_velocity.norm() + s.angular_velocity.norm() * w.store.radius[i];
  return {.resting = kRestingMargin * size, .travel = std::min(speed * w.dt, size)};
}

void updateProxies(World::Impl& w) {
  const uint32_t n = static_cast<uint32_t>(w.store.states.size());
  w.proxies.resize(n);
  w.reach.resize(n);
  const WorldBox box{w.def.center, w.def.extent};
  w.tasks.parallelFor(n, kProxyGrain, [&](TaskRange r) {
    for (uint32_t i = r.begin; i < r.end; ++i) {
      w.reach[i] = reachOf(w, i);
      const float margin = w.reach[i].resting + w.reach[i].travel;
      updateProxy(w.store.states[i], w.store.collidables[i], box, margin, w.proxies[i]);
    }
  });
}

}  // namespace

void begin(World::Impl& w) {
  w.refreshActive();
  w.constraints.clear();
  w.free_bodies = w.active;
}

void findPairsAnew(World::Impl& w) {
  updateProxies(w);
  const auto found = w.sweep.findPairs(w.proxies, axisOfLargestVariance(w.proxies), &w.tasks);
  w.pairs.assign(found.begin(), found.end());
  w.contacts.clear();
  for (Pair& p : w.pairs) p.contact_id = w.contacts.add();
}

void updatePairs(World::Impl& w) {
  updateProxies(w);
  const auto found = w.sweep.findPairs(w.proxies, axisOfLargestVariance(w.proxies), &w.tasks);
  w.next_pairs.assign(found.begin(), found.end());
  auto out = w.next_pairs.begin();
  comparePairs(
      w.pairs, found, [&](const Pair&) { (out++)->contact_id = w.contacts.add(); },
      [&](const Pair& old, const Pair&) { (out++)->contact_id = old.contact_id; },
      [&](const Pair& old) { w.contacts.remove(old.contact_id); });
  w.pairs.swap(w.next_pairs);
}

}  // namespace pfx::stage
