// What a world tells the application after a step, and what the application may say about contacts.
#include "pfx/high_level/world/events.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "pfx/high_level/world/world.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/counted_allocations.h"

namespace {

using namespace pfx;

constexpr float kStep = 1.0f / 60.0f;

BodyDef ball(const Vec3& position, float radius = 0.5f) {
  return {.pose = {.position = position}, .shapes = {Shape{Sphere{radius}, {}}}};
}
BodyDef plate(const Vec3& position, MotionType type = MotionType::Fixed) {
  return {.pose = {.position = position}, .motion_type = type, .shapes = {Shape{Box{Vec3(10.0f, 0.5f, 10.0f)}, {}}}};
}

// All events of some steps, as words.
std::string eventsOf(World& world, int steps) {
  std::string out;
  const auto pair = [&](const char* what, BodyId a, BodyId b) {
    out += std::to_string(world.stepCount()) + what + std::to_string(a.index) + "-" + std::to_string(b.index) + "\n";
  };
  for (int i = 0; i < steps; ++i) {
    world.step(kStep);
    const WorldEvents e = world.events();
    for (const TouchEvent& t : e.touch_begin) pair(" begin ", t.body_a, t.body_b);
    for (const TouchEvent& t : e.touch_end) pair(" end ", t.body_a, t.body_b);
    for (const HitEvent& h : e.hits) pair(" hit ", h.body_a, h.body_b);
    for (const TriggerEvent& t : e.trigger_enter) pair(" enter ", t.trigger, t.body);
    for (const TriggerEvent& t : e.trigger_leave) pair(" leave ", t.trigger, t.body);
    for (BodyId id : e.fell_asleep) pair(" sleep ", id, id);
    for (BodyId id : e.woke) pair(" wake ", id, id);
  }
  return out;
}

size_t countOf(const std::string& text, const std::string& word) {
  size_t count = 0;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

class EventPipelines : public testing::TestWithParam<Pipeline> {};

TEST_P(EventPipelines, ABallThatFallsBeginsToTouchOnceWithAHitAtTheSpeedOfItsFall) {
  World world({.pipeline = GetParam(), .report_events = true});
  BodyDef ground = plate(Vec3(0.0f, -0.5f, 0.0f)), falling = ball(Vec3(0.0f, 2.5f, 0.0f));
  ground.restitution = falling.restitution = 0.0f;
  world.addBody(ground);
  world.addBody(falling);
  std::vector<HitEvent> hits;
  size_t begins = 0, ends = 0;
  for (int i = 0; i < 180; ++i) {
    world.step(kStep);
    const WorldEvents e = world.events();
    hits.insert(hits.end(), e.hits.begin(), e.hits.end());
    begins += e.touch_begin.size(), ends += e.touch_end.size();
  }
  EXPECT_EQ(begins, 1u);
  EXPECT_EQ(ends, 0u) << "it rests";
  ASSERT_EQ(hits.size(), 1u);
  // v = sqrt(2 g h) for h = 2 m; the hit is known to a step.
  EXPECT_NEAR(hits[0].speed, 6.26f, 9.8f * kStep);
  EXPECT_NEAR(hits[0].normal.y(), 1.0f, 1e-3f);
  EXPECT_NEAR(hits[0].point.norm(), 0.0f, 0.15f);
}

TEST_P(EventPipelines, ABallThatBouncesBeginsAndEndsWithEachBounce) {
  World world({.pipeline = GetParam(), .report_events = true});
  BodyDef ground = plate(Vec3(0.0f, -0.5f, 0.0f));
  BodyDef bouncing = ball(Vec3(0.0f, 3.0f, 0.0f));
  ground.restitution = bouncing.restitution = 1.0f;
  world.addBody(ground);
  world.addBody(bouncing);
  // Falls 2.5 m in 0.71 s: bounces at 0.71, 2.14 and 3.57 s.
  const std::string events = eventsOf(world, 240);
  EXPECT_EQ(countOf(events, "begin 0-1"), 3u) << events;
  EXPECT_EQ(countOf(events, "end 0-1"), 3u) << events;
  EXPECT_EQ(countOf(events, "hit 0-1"), 3u) << events;
}

TEST_P(EventPipelines, ATriggerTellsWhoEntersAndLeavesAndChangesNothing) {
  WorldDef def{.pipeline = GetParam(), .report_events = true};
  World world(def);
  def.report_events = false;
  World alone(def);
  world.addBody(plate(Vec3(0.0f, -5.0f, 0.0f), MotionType::Trigger));
  world.addBody(ball(Vec3::Zero()));
  alone.addBody(ball(Vec3::Zero()));
  const std::string events = eventsOf(world, 120);
  for (int i = 0; i < 120; ++i) alone.step(kStep);
  EXPECT_EQ(countOf(events, "enter 0-1"), 1u) << events;
  EXPECT_EQ(countOf(events, "leave 0-1"), 1u) << events;
  EXPECT_EQ(countOf(events, "begin") + countOf(events, "hit"), 0u) << events;
  EXPECT_EQ(world.states()[1].position, alone.states()[0].position);
}

INSTANTIATE_TEST_SUITE_P(All, EventPipelines, testing::Values(Pipeline::Simple, Pipeline::Stable));

TEST(Events, ABodyThatFallsAsleepAndIsWokenSaysSoAndGoesOnTouching) {
  World world({.sleeping = true, .sleep_steps = 30, .report_events = true});
  world.addBody(plate(Vec3(0.0f, -0.5f, 0.0f)));
  const BodyId id = world.addBody({.pose = {.position = Vec3(0.0f, 0.5f, 0.0f)}, .shapes = {Shape{Box{Vec3::Constant(0.5f)}, {}}}});
  const std::string first = eventsOf(world, 120);
  EXPECT_EQ(countOf(first, "begin 0-1"), 1u) << first;
  EXPECT_EQ(countOf(first, "sleep 1-1"), 1u) << first;
  EXPECT_EQ(countOf(first, "end"), 0u) << first;
  world.state(id).linear_velocity = Vec3(0.0f, 0.0f, 0.01f);
  const std::string second = eventsOf(world, 10);
  EXPECT_EQ(countOf(second, "wake 1-1"), 1u) << second;
  EXPECT_EQ(countOf(second, "begin") + countOf(second, "end"), 0u) << second;
}

TEST(Events, ARemovedBodyCeasesToTouchAndTheNextOneInItsPlaceBegins) {
  World world({.report_events = true});
  world.addBody(plate(Vec3(0.0f, -0.5f, 0.0f)));
  const BodyDef resting = ball(Vec3(0.0f, 0.5f, 0.0f));
  const BodyId first = world.addBody(resting);
  eventsOf(world, 10);
  world.removeBody(first);
  const BodyId second = world.addBody(resting);
  ASSERT_EQ(first.index, second.index);
  world.step(kStep);
  ASSERT_EQ(world.events().touch_end.size(), 1u);
  EXPECT_EQ(world.events().touch_end[0].body_b, first);
  ASSERT_EQ(world.events().touch_begin.size(), 1u);
  EXPECT_EQ(world.events().touch_begin[0].body_b, second);
}

// A heap of boxes and balls over a trigger, with something of every event.
void addHeap(World& world) {
  world.addBody(plate(Vec3(0.0f, -0.5f, 0.0f)));
  world.addBody(plate(Vec3(0.0f, 1.5f, 0.0f), MotionType::Trigger));
  for (int i = 0; i < 40; ++i) {
    const Vec3 at(0.9f * static_cast<float>(i % 4), 1.0f + static_cast<float>(i / 4), 0.4f * static_cast<float>(i % 3));
    world.addBody(i % 2 == 0 ? ball(at, 0.4f) : BodyDef{.pose = {.position = at}, .shapes = {Shape{Box{Vec3::Constant(0.4f)}, {}}}});
  }
}

TEST(Events, AreTheSameForEveryNumberOfWorkers) {
  std::string events[2];
  for (int k = 0; k < 2; ++k) {
    World world({.workers = k == 0 ? 1 : 3, .sleeping = true, .report_events = true});
    addHeap(world);
    events[k] = eventsOf(world, 200);
  }
  EXPECT_GT(countOf(events[0], "begin"), 40u);
  EXPECT_EQ(events[0], events[1]);
}

TEST(Events, GoOnTheSameAfterASnapshot) {
  World world({.sleeping = true, .sleep_steps = 20, .report_events = true}), other;
  addHeap(world);
  eventsOf(world, 60);
  std::vector<std::byte> bytes(world.snapshotBytes());
  world.snapshot(bytes);
  other.restore(bytes);
  EXPECT_EQ(eventsOf(other, 200), eventsOf(world, 200));
}

TEST(Events, DoNotChangeWhatHappensAndRunNoStageWhenNobodyAsks) {
  World asked({.report_events = true}), silent;
  addHeap(asked);
  addHeap(silent);
  for (int i = 0; i < 120; ++i) asked.step(kStep), silent.step(kStep);
  EXPECT_EQ(asked.stateHash(), silent.stateHash());
  for (std::string_view stage : silent.stages()) EXPECT_TRUE(stage != "events" && stage != "approaches") << stage;
  EXPECT_TRUE(silent.events().touch_begin.empty());
}

TEST(Events, CostNoAllocationOnceWarm) {
  World world({.report_events = true});
  BodyDef ground = plate(Vec3(0.0f, -0.5f, 0.0f)), bouncing = ball(Vec3::Zero());
  ground.restitution = bouncing.restitution = 1.0f;
  world.addBody(ground);
  // All bounce at once, so that the lists of events have had their greatest length when the world is warm.
  for (int i = 0; i < 16; ++i) {
    bouncing.pose.position = Vec3(1.2f * static_cast<float>(i) - 9.0f, 1.0f, 0.0f);
    world.addBody(bouncing);
  }
  for (int i = 0; i < 600; ++i) world.step(kStep);
  const long before = support::g_allocations.load();
  size_t events = 0;
  for (int i = 0; i < 300; ++i) world.step(kStep), events += world.events().touch_begin.size();
  EXPECT_GT(events, 10u);
  EXPECT_EQ(support::g_allocations.load() - before, 0);
}

TEST(PairsKeptApart, DoNotCollideUntilTheyMay) {
  World world;
  const BodyId ground = world.addBody(plate(Vec3(0.0f, -0.5f, 0.0f)));
  const BodyId ghost = world.addBody(ball(Vec3(0.0f, 0.5f, 0.0f))), solid = world.addBody(ball(Vec3(3.0f, 0.5f, 0.0f)));
  world.keepApart(ghost, ground);
  EXPECT_TRUE(world.areKeptApart(ground, ghost));
  EXPECT_FALSE(world.areKeptApart(ground, solid));
  for (int i = 0; i < 30; ++i) world.step(kStep);
  EXPECT_LT(world.states()[ghost.index].position.y(), -0.5f);
  EXPECT_NEAR(world.states()[solid.index].position.y(), 0.5f, 0.01f);
  world.letCollide(ghost, ground);
  EXPECT_FALSE(world.areKeptApart(ground, ghost));
}

TEST(PairsKeptApart, EveryStoredPairIsFoundAndForgottenWithItsBody) {
  World world;
  std::vector<BodyId> ids;
  for (int i = 0; i < 20; ++i) ids.push_back(world.addBody(ball(Vec3(2.0f * static_cast<float>(i), 0.0f, 0.0f))));
  for (size_t i = 0; i + 1 < ids.size(); ++i) world.keepApart(ids[i + 1], ids[i]);
  for (size_t i = 0; i < ids.size(); ++i)
    for (size_t k = 0; k < ids.size(); ++k) EXPECT_EQ(world.areKeptApart(ids[i], ids[k]), i + 1 == k || k + 1 == i);
  world.removeBody(ids[5]);
  const BodyId again = world.addBody(ball(Vec3::Zero()));
  ASSERT_EQ(again.index, ids[5].index);
  EXPECT_FALSE(world.areKeptApart(again, ids[4]));
  EXPECT_THROW(world.keepApart(ids[5], ids[4]), std::invalid_argument);
  EXPECT_THROW(world.keepApart(again, again), std::invalid_argument);
}

TEST(ContactCallbacks, AFilterDecidesWhoMayTouch) {
  World world;
  const BodyId ground = world.addBody(plate(Vec3(0.0f, -0.5f, 0.0f)));
  const BodyId a = world.addBody(ball(Vec3(0.0f, 0.5f, 0.0f))), b = world.addBody(ball(Vec3(3.0f, 0.5f, 0.0f)));
  world.setPairFilter([&](BodyId x, BodyId y) { return !(x == ground && y == a); });
  for (int i = 0; i < 30; ++i) world.step(kStep);
  EXPECT_LT(world.states()[a.index].position.y(), -0.5f);
  EXPECT_NEAR(world.states()[b.index].position.y(), 0.5f, 0.01f);
}

// Two long triangles, number 0 for z < 0 and number 1 for z > 0; a box slides along x on each.
TEST(ContactCallbacks, AModifierGivesEachTriangleOfAMeshItsOwnFriction) {
  const Vec3 vertices[] = {{-50.0f, 0.0f, -20.0f}, {-50.0f, 0.0f, 0.0f}, {50.0f, 0.0f, 0.0f}, {50.0f, 0.0f, -20.0f},
                           {-50.0f, 0.0f, 20.0f},  {50.0f, 0.0f, 20.0f}};
  const uint32_t triangles[] = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2}, user_data[] = {7, 7, 9, 9};
  LargeMeshOptions options;
  options.user_data = user_data;
  World world;
  const LargeMesh* mesh = world.keep(buildLargeMesh(vertices, triangles, options).mesh);
  world.addBody({.motion_type = MotionType::Fixed, .shapes = {Shape{mesh, {}}}});
  BodyId boxes[2];
  for (int i = 0; i < 2; ++i)
    boxes[i] = world.addBody({.pose = {.position = Vec3(-40.0f, 0.5f, i == 0 ? -5.0f : 5.0f)},
                              .linear_velocity = Vec3(5.0f, 0.0f, 0.0f),
                              .shapes = {Shape{Box{Vec3::Constant(0.5f)}, {}}}});
  world.setContactModifier([](ContactModification& m) {
    EXPECT_TRUE(m.user_data[0] == 7u || m.user_data[0] == 9u) << m.user_data[0];
    m.friction = m.user_data[0] == 7u ? 0.0f : 0.5f;
    return true;
  });
  for (int i = 0; i < 120; ++i) world.step(kStep);
  EXPECT_NEAR(world.states()[boxes[0].index].linear_velocity.x(), 5.0f, 1e-3f) << "there is no friction";
  // Stops after v / (mu g) = 1.02 s and v^2 / (2 mu g) = 2.55 m.
  EXPECT_NEAR(world.states()[boxes[1].index].position.x(), -40.0f + 2.55f, 0.05f);
  EXPECT_LT(world.states()[boxes[1].index].linear_velocity.norm(), 0.01f);
}

TEST(ContactCallbacks, AModifierThatRefusesLetsBodiesThroughFromOneSide) {
  World world({.gravity = Vec3::Zero()});
  world.addBody(plate(Vec3::Zero()));
  const auto shoot = [&](float from) {
    BodyDef def = ball(Vec3(from, from, 0.0f));
    def.linear_velocity = Vec3(0.0f, -from, 0.0f);
    return world.addBody(def);
  };
  const BodyId down = shoot(3.0f), up = shoot(-3.0f);
  // One-way: only what comes from above is held up. The plate is body A, its normal points to the ball.
  world.setContactModifier([](ContactModification& m) { return m.manifold.normal.y() > 0.5f; });
  for (int i = 0; i < 120; ++i) world.step(kStep);
  EXPECT_GT(world.states()[down.index].position.y(), 0.9f);
  EXPECT_GT(world.states()[up.index].position.y(), 0.9f) << "it came through from below";
}

TEST(ContactCallbacks, AModifierThatChangesNothingLeavesEveryBitAsItIs) {
  World plain, modified;
  addHeap(plain);
  addHeap(modified);
  modified.setContactModifier([](ContactModification&) { return true; });
  for (int i = 0; i < 120; ++i) {
    plain.step(kStep), modified.step(kStep);
    ASSERT_EQ(plain.stateHash(), modified.stateHash()) << i;
  }
}

}  // namespace
