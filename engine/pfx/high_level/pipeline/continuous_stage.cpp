// Continuous collision: what moves far in one step is stopped where it first touches something, so that
// nothing passes through anything. The rest of the step is lost to it; the next one finds the contact and
// deals with the impact.
#include <algorithm>

#include "pfx/base_level/math/trig.h"
#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"
#include "pfx/low_level/broadphase/shape_tree.h"
#include "pfx/low_level/collision/body_pair.h"
#include "pfx/low_level/continuous/time_of_impact.h"

namespace pfx::stage {
namespace {

// Distances as shares of a body's smallest half extent: a body is fast when its surface moves farther than
// the first, and stops when nearer than the second, which is within the margin that makes contacts.
constexpr float kFast = 0.5f;
constexpr float kStop = 0.005f;
constexpr uint32_t kPairGrain = 8;
constexpr size_t kManyShapes = 4;  // of a body, from which on it pays to ask which can be reached

Vec3 rotationVector(const Quat& from, const Quat& to) {
  Quat turn = to * from.conjugate();
  if (turn.w() < 0.0f) turn.coeffs() = -turn.coeffs();
  const float sine = turn.vec().norm();
  if (sine == 0.0f) return Vec3::Zero();
  return 2.0f * atan2(sine, turn.w()) / sine * turn.vec();
}

Sweep measureSweep(const World::Impl& w, uint32_t i) {
  const RigidState& s = w.store.states[i];
  const Transform& start = w.start_poses[i];
  return {start, s.position - start.position, rotationVector(start.orientation, s.orientation)};
}

Sweep sweepOf(const World::Impl& w, uint32_t i) {
  const RigidState& s = w.store.states[i];
  return moves(s) ? w.sweeps[i] : Sweep{.start = s.pose()};
}

bool isFast(const World::Impl& w, uint32_t i) {
  const Sweep& sweep = w.sweeps[i];
  return sweep.motion.norm() + sweep.rotation.norm() * w.store.radius[i] > kFast * w.store.size[i];
}

// How far the surface of body `i` moves as `frame` sees it, at most: what turns with a drum stands still in it. The last
// two terms are what the first ones leave out, of second order in the turns.
float travelSeenFrom(const World::Impl& w, uint32_t i, uint32_t frame) {
  const Sweep own = sweepOf(w, i), other = sweepOf(w, frame);
  const Vec3 arm = own.start.position - other.start.position;
  const Vec3 motion = own.motion - other.motion;
  const float radius = w.store.radius[i], turn = other.rotation.norm();
  return (motion - other.rotation.cross(arm)).norm() + radius * (own.rotation - other.rotation).norm() +
         turn * (motion.norm() + 0.5f * turn * arm.norm()) + 0.5f * radius * own.rotation.cross(other.rotation).norm();
}

// Whether one body of the pair is so fast, as the other sees it, that they could pass through each other.
bool mayPass(const World::Impl& w, const Pair& pair) {
  const auto is_fast = [&](uint32_t i, uint32_t frame) {
    return moves(w.store.states[i]) && w.is_fast[i] && travelSeenFrom(w, i, frame) > kFast * w.store.size[i];
  };
  return is_fast(pair.body_a, pair.body_b) || is_fast(pair.body_b, pair.body_a);
}

// Which shapes a pair is swept with.
struct Swept {
  std::span<const Shape> a, b;
  float tolerance;
};

// Calls fn(shape) for those of the shapes of `body` that `other` may reach on its way.
template <class Fn>
void visitReached(const World::Impl& w, uint32_t body, uint32_t other, const Swept& swept, Fn&& fn) {
  const auto shapes = w.store.collidables[body].shapes();
  const Vec3 at = sweepOf(w, body).start.applyInverse(sweepOf(w, other).start.position);
  const float reach = w.store.radius[other] + travelSeenFrom(w, other, body) + swept.tolerance;
  visitShapes(w.store.collidables[body], Aabb{at, at}.grown(reach), [&](uint32_t i) { fn(shapes[i]); });
}

Impact firstTouch(const World::Impl& w, const Pair& pair, const Swept& swept) {
  const Sweep sweep_a = sweepOf(w, pair.body_a), sweep_b = sweepOf(w, pair.body_b);
  Impact first;
  const auto sweep = [&](const Shape& a, const Shape& b) {
    const Impact impact = timeOfImpact({a, sweep_a, b, sweep_b, swept.tolerance, first.fraction});
    if (impact.state == Impact::State::Hit) first = impact;
  };
  const auto sweepAll = [&](const Shape& a) {
    if (swept.b.size() < kManyShapes)
      for (const Shape& b : swept.b) sweep(a, b);
    else
      visitReached(w, pair.body_b, pair.body_a, swept, [&](const Shape& b) { sweep(a, b); });
  };
  if (swept.a.size() < kManyShapes)
    for (const Shape& a : swept.a) sweepAll(a);
  else
    visitReached(w, pair.body_a, pair.body_b, swept, sweepAll);
  return first;
}

// Whether an impact is on an edge where the surface goes on in another mesh.
bool isOnSeam(const World::Impl& w, const Pair& pair, const Impact& impact, float tolerance) {
  const bool mesh_a = hasMesh(w.store.collidables[pair.body_a]);
  const auto meshes = meshPairsOf(w.detector.meshPairs(), mesh_a ? pair.body_b : pair.body_a);
  if (impact.triangle == kNoFacet || meshes.size() < 2) return false;
  const SurfacePoint at{impact.point, mesh_a ? impact.normal : Vec3(-impact.normal), tolerance};
  SeamVerdict verdict;
  for (const MeshPair& m : meshes)
    judge(w.store.collidables[m.mesh_body], sweepOf(w, m.mesh_body).at(impact.fraction), at, verdict);
  return verdict.isGhost();
}

// First touch of the bodies of a pair. Bodies that touch already have contacts, which let them slide and roll
// on each other; only the core of the faster one must not go through.
Impact firstImpact(const World::Impl& w, const Pair& pair, float tolerance) {
  const auto shapes_a = w.store.collidables[pair.body_a].shapes(), shapes_b = w.store.collidables[pair.body_b].shapes();
  if (w.contacts.manifolds(pair.contact_id).empty()) {
    const Impact impact = firstTouch(w, pair, {shapes_a, shapes_b, tolerance});
    if (!impact.touches() || !isOnSeam(w, pair, impact, tolerance)) return impact;
  }
  const auto core = [&](uint32_t i) { return Shape{Sphere{0.5f * w.store.size[i]}, {}}; };
  const Shape core_a = core(pair.body_a), core_b = core(pair.body_b);
  Swept cores{shapes_a, shapes_b, tolerance};
  if (w.is_fast[pair.body_a]) cores.a = {&core_a, 1};
  if (w.is_fast[pair.body_b]) cores.b = {&core_b, 1};
  return firstTouch(w, pair, cores);
}

// How far the obstacle carries what it has stopped during the rest of the step. One that is stopped itself
// does not.
Vec3 carriedBy(const World::Impl& w, const Stop& stop) {
  if (moves(w.store.states[stop.by]) && w.stops[stop.by].fraction < 1.0f) return Vec3::Zero();
  const Sweep sweep = sweepOf(w, stop.by);
  const Vec3 local = sweep.at(stop.fraction).applyInverse(stop.point);
  return sweep.at(1.0f).apply(local) - stop.point;
}

}  // namespace

void rememberPoses(World::Impl& w) {
  w.start_poses.resize(w.store.states.size());
  for (uint32_t i : w.moving) w.start_poses[i] = w.store.states[i].pose();
}

void stopAtImpacts(World::Impl& w) {
  w.is_fast.resize(w.store.states.size());
  w.stops.resize(w.store.states.size());
  w.sweeps.resize(w.store.states.size());
  bool any = false;
  for (uint32_t i : w.moving) {
    w.sweeps[i] = measureSweep(w, i);
    w.is_fast[i] = isFast(w, i);
    w.stops[i] = Stop{};
    any = any || w.is_fast[i];
  }
  if (!any) return;

  const auto fast = [&](uint32_t i) { return moves(w.store.states[i]) && w.is_fast[i]; };
  w.fast_pairs.clear();
  for (uint32_t i = 0; i < w.pairs.size(); ++i)
    if ((fast(w.pairs[i].body_a) || fast(w.pairs[i].body_b)) && w.solves(w.pairs[i])) w.fast_pairs.push_back({i, {}});
  w.tasks.parallelFor(static_cast<uint32_t>(w.fast_pairs.size()), kPairGrain, [&](TaskRange r) {
    for (FastPair& f : std::span(w.fast_pairs).subspan(r.begin, r.end - r.begin)) {
      const Pair& pair = w.pairs[f.pair];
      if (!mayPass(w, pair)) continue;
      f.impact = firstImpact(w, pair, kStop * std::min(w.store.size[pair.body_a], w.store.size[pair.body_b]));
    }
  });
  for (const FastPair& f : w.fast_pairs) {
    const Pair& pair = w.pairs[f.pair];
    const auto stop = [&](uint32_t body, uint32_t by) {
      const bool can_stop = fast(body) && isDynamic(w.store.states[body].motion_type);
      if (can_stop && f.impact.fraction < w.stops[body].fraction)
        w.stops[body] = {f.impact.fraction, f.impact.point, by};
    };
    stop(pair.body_a, pair.body_b);
    stop(pair.body_b, pair.body_a);
  }
  w.stopped_poses.clear();
  for (uint32_t i : w.moving) {
    if (w.stops[i].fraction >= 1.0f) continue;
    const Transform stopped = sweepOf(w, i).at(w.stops[i].fraction);
    w.stopped_poses.push_back(
        {i, {stopped.position + carriedBy(w, w.stops[i]), stopped.orientation.normalized()}});
  }
  for (const BodyPose& stopped : w.stopped_poses) {
    w.store.states[stopped.body].position = stopped.pose.position;
    w.store.states[stopped.body].orientation = stopped.pose.orientation;
  }
}

}  // namespace pfx::stage
