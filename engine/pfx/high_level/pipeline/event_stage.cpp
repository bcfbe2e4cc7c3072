// Events: which bodies began and ceased to touch in a step, which fell asleep and woke.
#include <algorithm>

#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx::stage {
namespace {

// Gaps, as shares of a body's smallest half extent, at which a touch begins and ends.
constexpr float kBegin = 0.005f, kEnd = 0.01f;
constexpr float kLeastGap = 1e-4f;  // m
constexpr float kFar = 1e30f;       // m

struct Gap {
  float distance = kFar;                              // m, of the nearest point
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitY();  // world
};

// The smallest gap between two bodies where they are now.
Gap gapOf(const World::Impl& w, const Pair& pair) {
  const Transform a = w.store.states[pair.body_a].pose(), b = w.store.states[pair.body_b].pose();
  Gap gap;
  for (const ContactManifold& m : w.contacts.manifolds(pair.contact_id)) {
    const Vec3 normal = a.orientation * m.local_normal;
    for (int i = 0; i < m.num_points; ++i) {
      const Vec3 on_b = b.apply(m.points[i].local_b);
      const float distance = normal.dot(on_b - a.apply(m.points[i].local_a));
      if (distance < gap.distance) gap = {distance, on_b, normal};
    }
  }
  return gap;
}

Vec3 velocityAt(const RigidState& s, const Vec3& point) {
  return s.linear_velocity + s.angular_velocity.cross(point - s.position);
}

float approachSpeed(const World::Impl& w, const Pair& pair, const Vec3& point, const Vec3& normal) {
  const RigidState &a = w.store.states[pair.body_a], &b = w.store.states[pair.body_b];
  return normal.dot(velocityAt(a, point) - velocityAt(b, point));
}

bool isTrigger(const World::Impl& w, const Pair& pair) {
  return w.store.states[pair.body_a].motion_type == MotionType::Trigger ||
         w.store.states[pair.body_b].motion_type == MotionType::Trigger;
}

// Whether bodies that did not touch before the step do so at its end, or did within it: then the solver has stopped an
// approach that would have closed the gap.
bool beginsToTouch(const World::Impl& w, const Pair& pair, const Gap& now, const Approach* before) {
  if (isTrigger(w, pair)) return now.distance <= 0.0f;
  const float size = std::min(w.store.size[pair.body_a], w.store.size[pair.body_b]);
  if (now.distance <= std::max(kBegin * size, kLeastGap)) return true;
  if (before == nullptr || before->gap > w.dt * before->speed) return false;
  return approachSpeed(w, pair, before->point, before->normal) < 0.5f * before->speed;
}

bool stillTouches(const World::Impl& w, const Pair& pair, const Gap& now) {
  if (isTrigger(w, pair)) return now.distance <= 0.0f;
  const float size = std::min(w.store.size[pair.body_a], w.store.size[pair.body_b]);
  return now.distance <= std::max(kEnd * size, 2.0f * kLeastGap);
}

void reportBegin(World::Impl& w, const TouchingPair& t, const Approach* before) {
  EventStore& e = w.events;
  if (t.is_trigger) {
    const bool a = w.store.states[t.body_a.index].motion_type == MotionType::Trigger;
    e.enter.push_back({a ? t.body_a : t.body_b, a ? t.body_b : t.body_a});
    return;
  }
  e.begin.push_back({t.body_a, t.body_b});
  if (before != nullptr && before->speed > w.def.hit_speed)
    e.hits.push_back({t.body_a, t.body_b, before->point, before->normal, before->speed});
}

void reportEnd(World::Impl& w, const TouchingPair& t) {
  EventStore& e = w.events;
  if (!t.is_trigger) return e.end.push_back({t.body_a, t.body_b});
  const RigidState& a = w.store.states[t.body_a.index];
  const bool a_is_trigger = w.store.isValid(t.body_a) && a.motion_type == MotionType::Trigger;
  e.leave.push_back({a_is_trigger ? t.body_a : t.body_b, a_is_trigger ? t.body_b : t.body_a});
}

// A pair that is not among those that move: it goes on touching when both bodies stand where they stood.
void carryOver(World::Impl& w, const TouchingPair& t) {
  const bool stands = w.store.isValid(t.body_a) && w.store.isValid(t.body_b) && !moves(w.store.states[t.body_a.index]) &&
                      !moves(w.store.states[t.body_b.index]);
  if (stands)
    w.events.next_touching.push_back(t);
  else
    reportEnd(w, t);
}

const Approach* find(std::span<const Approach> sorted, uint64_t key) {
  const auto it = std::lower_bound(sorted.begin(), sorted.end(), key,
                                   [](const Approach& a, uint64_t k) { return a.key < k; });
  return it == sorted.end() || it->key != key ? nullptr : &*it;
}

void reportPair(World::Impl& w, const Pair& pair, const TouchingPair* before) {
  const auto id = [&](uint32_t body) { return BodyId{body, w.store.generations[body]}; };
  const TouchingPair now{id(pair.body_a), id(pair.body_b), isTrigger(w, pair)};
  if (before != nullptr && (before->body_a != now.body_a || before->body_b != now.body_b ||
                            before->is_trigger != now.is_trigger)) {
    reportEnd(w, *before);  // of bodies that had these places before
    before = nullptr;
  }
  const Gap gap = gapOf(w, pair);
  if (before != nullptr) {
    if (!stillTouches(w, pair, gap)) return reportEnd(w, *before);
  } else {
    const Approach* approach = find(w.events.approaches, pair.key());
    if (!beginsToTouch(w, pair, gap, approach)) return;
    reportBegin(w, now, approach);
  }
  w.events.next_touching.push_back(now);
}

void reportTouches(World::Impl& w) {
  EventStore& e = w.events;
  e.next_touching.clear();
  auto before = e.touching.cbegin();
  for (const Pair& pair : w.pairs) {
    for (; before != e.touching.cend() && before->key() < pair.key(); ++before) carryOver(w, *before);
    const bool known = before != e.touching.cend() && before->key() == pair.key();
    reportPair(w, pair, known ? &*before : nullptr);
    if (known) ++before;
  }
  for (; before != e.touching.cend(); ++before) carryOver(w, *before);
  e.touching.swap(e.next_touching);
  e.next_touching.reserve(e.touching.capacity());  // the two take turns
}

// Bodies that exist, each once, ascending.
void takeOver(World::Impl& w, Vector<BodyId>& from, Vector<BodyId>& to) {
  to.swap(from);
  from.clear();
  std::erase_if(to, [&](BodyId id) { return !w.store.isValid(id); });
  std::sort(to.begin(), to.end(), [](BodyId a, BodyId b) { return a.index < b.index; });
  to.erase(std::unique(to.begin(), to.end()), to.end());
}

}  // namespace

void noteApproaches(World::Impl& w) {
  EventStore& e = w.events;
  e.approaches.clear();
  auto touching = e.touching.cbegin();
  for (const Pair& pair : w.pairs) {
    while (touching != e.touching.cend() && touching->key() < pair.key()) ++touching;
    if (touching != e.touching.cend() && touching->key() == pair.key()) continue;
    if (w.contacts.manifolds(pair.contact_id).empty() || !w.solves(pair)) continue;
    const Gap gap = gapOf(w, pair);
    const float speed = approachSpeed(w, pair, gap.point, gap.normal);
    if (speed > 0.0f) e.approaches.push_back({pair.key(), gap.distance, speed, gap.point, gap.normal});
  }
}

void reportEvents(World::Impl& w) {
  EventStore& e = w.events;
  e.begin.clear(), e.end.clear(), e.hits.clear(), e.enter.clear(), e.leave.clear();
  reportTouches(w);
  takeOver(w, e.next_fell_asleep, e.fell_asleep);
  takeOver(w, e.next_woke, e.woke);
}

}  // namespace pfx::stage
