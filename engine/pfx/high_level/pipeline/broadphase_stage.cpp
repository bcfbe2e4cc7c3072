// Broad phase of a world: bounds with margins, pairs, and the contacts that belong to them.
#include <algorithm>

#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx::stage {
namespace {

// Share of a body's smallest half extent that contacts reach ahead of touching.
constexpr float kRestingMargin = 0.02f;
constexpr uint32_t kProxyGrain = 256;

struct BodyReach {
  ContactReach contacts;
  float margin;  // m, of the bounds, which are stretched along the way of the body as well
};

BodyReach reachOf(const World::Impl& w, uint32_t i) {
  const RigidState& s = w.store.states[i];
  const float size = w.store.size[i], resting = kRestingMargin * size;
  const MeshMotion* motion = w.motionOf(i);
  const float surface = motion ? w.dt * motion->fastest : 0.0f;
  const float around = w.dt * s.angular_velocity.norm() * w.store.radius[i] + surface;
  const float travel = w.dt * s.linear_velocity.norm() + around;
  return {{.resting = resting, .travel = std::min(travel, size), .surface = std::min(surface, size)},
          resting + std::min(around, size)};
}

// Writes the proxies of `bodies`, with bounds that hold what they may touch in the step.
void makeProxies(World::Impl& w, std::span<const uint32_t> bodies, Vector<BroadphaseProxy>& proxies) {
  proxies.resize(bodies.size());
  w.reach.resize(w.store.states.size());
  const WorldBox box{w.def.center, w.def.extent};
  w.tasks.parallelFor(static_cast<uint32_t>(bodies.size()), kProxyGrain, [&](TaskRange r) {
    for (uint32_t k = r.begin; k < r.end; ++k) {
      const uint32_t i = bodies[k];
      const BodyReach reach = reachOf(w, i);
      w.reach[i] = reach.contacts;
      const RigidState& s = w.store.states[i];
      if (updateProxy(s, w.store.collidables[i], box, reach.margin, proxies[k]) == Error::OutOfWorld)
        proxies[k].filter_self = proxies[k].filter_target = 0;
      if (!moves(s)) continue;
      // The whole way of the step, so that fast bodies find what they could pass through.
      const Vec3 way = w.dt * s.linear_velocity;
      proxies[k].bounds.min += way.cwiseMin(0.0f);
      proxies[k].bounds.max += way.cwiseMax(0.0f);
    }
  });
}

void restChangedBodies(World::Impl& w) {
  auto& changed = w.changed_bodies;
  std::erase_if(changed, [&](uint32_t i) {
    if (w.store.exists(i)) return moves(w.store.states[i]);
    w.tree.remove(i);
    return true;
  });
  makeProxies(w, changed, w.proxies);
  w.tree.rest(w.proxies);
  changed.clear();
}

}  // namespace

void begin(World::Impl& w) {
  w.refreshActive();
  w.constraints.clear();
  for (uint32_t i : w.solved) w.solver_index[i] = kNoSolverBody;
  w.solved.clear();
  w.solver_index.resize(w.store.states.size(), kNoSolverBody);
  w.joint_step.clear();
  w.free_components.clear();
  w.joint_constraints.clear();
  w.any_strained = false;
  w.num_newton_islands = 0;
  w.free_bodies = w.active;
  w.tree_is_current = false;
  rememberPoses(w);
  if (w.particle_store.empty()) return;
  w.particle_store.start_poses.clear();
  for (const RigidState& s : w.store.states) w.particle_store.start_poses.push_back(s.pose());
}

void findPairsAnew(World::Impl& w) {
  w.all_bodies.clear();
  for (uint32_t i = 0; i < w.store.states.size(); ++i)
    if (w.store.exists(i)) w.all_bodies.push_back(i);
  makeProxies(w, w.all_bodies, w.proxies);
  const auto found = w.sweep.findPairs(w.proxies, axisOfLargestVariance(w.proxies), &w.tasks);
  w.pairs.assign(found.begin(), found.end());
  dropApart(w, w.pairs);
  w.contacts.clear();
  for (Pair& p : w.pairs) p.contact_id = w.contacts.add();
}

void updateTree(World::Impl& w) {
  restChangedBodies(w);
  makeProxies(w, w.moving, w.proxies);
  w.tree.update(w.proxies, &w.tasks);
}

void updatePairs(World::Impl& w) {
  updateTree(w);
  const auto found = w.tree.activePairs();
  w.next_pairs.assign(found.begin(), found.end());
  dropApart(w, w.next_pairs);
  auto out = w.next_pairs.begin();
  comparePairs(
      w.pairs, w.next_pairs, [&](const Pair&) { (out++)->contact_id = w.contacts.add(); },
      [&](const Pair& old, const Pair&) { (out++)->contact_id = old.contact_id; },
      [&](const Pair& old) { w.contacts.remove(old.contact_id); });
  w.pairs.swap(w.next_pairs);
}

}  // namespace pfx::stage
