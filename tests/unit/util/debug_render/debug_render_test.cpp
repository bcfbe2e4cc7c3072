// What the debug renderer calls back, counted and looked at.
#include "pfx/util/debug_render/debug_render.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "pfx/util/debug_render/palette.h"

namespace pfx {
namespace {

struct Record {
  std::vector<Vec3> points;
  std::vector<std::pair<Vec3, Vec3>> lines;
  std::vector<Aabb> boxes;
  std::vector<Color> colors;
  std::map<uint64_t, int> definitions;
  std::vector<std::pair<uint64_t, std::vector<SolidInstance>>> batches;

  DebugRenderCallbacks callbacks() {
    DebugRenderCallbacks c;
    c.context = this;
    c.point = [](void* r, const Vec3& p, Color) { self(r).points.push_back(p); };
    c.line = [](void* r, const Vec3& from, const Vec3& to, Color color) {
      self(r).lines.emplace_back(from, to);
      self(r).colors.push_back(color);
    };
    c.aabb = [](void* r, const Vec3& center, const Vec3& half, Color color) {
      self(r).boxes.push_back({center - half, center + half});
      self(r).colors.push_back(color);
    };
    c.define_solid = [](void* r, uint64_t key, const Geometry&) { ++self(r).definitions[key]; };
    c.draw_solids = [](void* r, uint64_t key, std::span<const SolidInstance> s) {
      self(r).batches.push_back({key, {s.begin(), s.end()}});
    };
    return c;
  }
  static Record& self(void* r) { return *static_cast<Record*>(r); }
};

// Boxes, spheres and one body of two shapes along x.
struct Bodies {
  std::vector<RigidState> states{6};
  std::vector<Collidable> collidables{6};
  std::vector<Shape> two{2};

  Bodies() {
    two[0].geometry = Box{Vec3(1, 1, 1)};
    two[1].geometry = Capsule{1.0f, 0.5f};
    two[1].offset.position = Vec3(0, 2, 0);
    for (std::size_t i = 0; i < 6; ++i) {
      states[i].position = Vec3(10.0f * static_cast<float>(i), 0, 0);
      if (i % 2 == 0) collidables[i].inline_shape.geometry = Sphere{1.0f};
      if (i % 2 == 1) collidables[i].inline_shape.geometry = Box{Vec3(1, 1, 1)};
      collidables[i].half_extent = Vec3::Ones();
    }
    collidables[5].external = two;
  }
};

TEST(DebugRender, drawsOneBoxForTheWorldAndOnePerVisibleBody) {
  Record record;
  DebugRender debug(record.callbacks());
  const Bodies bodies;
  debug.renderWorld(Vec3(1, 2, 3), Vec3(4, 5, 6));
  ASSERT_EQ(record.boxes.size(), 1u);
  EXPECT_EQ(record.boxes[0].max, Vec3(5, 7, 9));
  debug.resetVisible(6);
  debug.setVisible(2, false);
  EXPECT_FALSE(debug.getVisible(2));
  debug.renderAabb(bodies.states, bodies.collidables);
  ASSERT_EQ(record.boxes.size(), 6u);
  EXPECT_EQ(record.boxes[3].min, Vec3(29, -1, -1));  // body 3; body 2 is not shown
  debug.resetVisible(6);
  EXPECT_TRUE(debug.getVisible(2));
  EXPECT_TRUE(debug.getVisible(1000));
}

TEST(DebugRender, drawsRedGreenAndBlueAxesOfTheBodyFrame) {
  Record record;
  DebugRender debug(record.callbacks());
  debug.scale = 2.0f;
  std::vector<RigidState> states(1);
  states[0].position = Vec3(1, 0, 0);
  states[0].orientation = Quat(0, 0, 0, 1);  // half a turn about z
  debug.renderLocalAxis(states);
  ASSERT_EQ(record.lines.size(), 3u);
  EXPECT_EQ(record.lines[0].second, Vec3(-1, 0, 0));
  EXPECT_EQ(record.lines[1].second, Vec3(1, -2, 0));
  EXPECT_EQ(record.lines[2].second, Vec3(1, 0, 2));
  for (int k = 0; k < 3; ++k) {
    const Color color = record.colors[static_cast<std::size_t>(k)];
    const uint32_t channels[3] = {color >> 16 & 255, color >> 8 & 255, color & 255};
    for (int j = 0; j < 3; ++j) EXPECT_LE(channels[j], channels[k]);
  }
}

TEST(DebugRender, drawsOneBoxAroundTheVisibleBodiesOfAnIsland) {
  Record record;
  DebugRender debug(record.callbacks());
  const Bodies bodies;
  const std::vector<uint32_t> island = {1, 2, 4};
  debug.setVisible(4, false);
  debug.renderIsland(0, island, bodies.states, bodies.collidables);
  ASSERT_EQ(record.boxes.size(), 1u);
  EXPECT_EQ(record.boxes[0].min, Vec3(9, -1, -1));
  EXPECT_EQ(record.boxes[0].max, Vec3(21, 1, 1));
  const std::vector<uint32_t> hidden = {4};
  debug.renderIsland(1, hidden, bodies.states, bodies.collidables);
  EXPECT_EQ(record.boxes.size(), 1u);
}

TEST(DebugRender, drawsAPointAndAnOutwardNormalOnEachVisibleSideOfAContact) {
  Record record;
  DebugRender debug(record.callbacks());
  std::vector<RigidState> states(2);
  states[1].position = Vec3(0, 2, 0);
  ContactManifold manifold;
  manifold.num_points = 2;
  for (int i = 0; i < 2; ++i) {
    manifold.points[static_cast<std::size_t>(i)].local_a = Vec3(static_cast<float>(i), 1, 0);
    manifold.points[static_cast<std::size_t>(i)].local_b = Vec3(static_cast<float>(i), -1, 0);
  }
  debug.renderContact(states, Pair{0, 1, 0, 0}, std::span(&manifold, 1));
  ASSERT_EQ(record.points.size(), 4u);
  ASSERT_EQ(record.lines.size(), 4u);
  for (const auto& [from, to] : record.lines) EXPECT_EQ(from.y(), 1.0f);
  EXPECT_EQ(record.lines[0].second.y(), 2.0f);  // out of A
  EXPECT_EQ(record.lines[1].second.y(), 0.0f);  // out of B
  debug.setVisible(0, false);
  debug.renderContact(states, Pair{0, 1, 0, 0}, std::span(&manifold, 1));
  EXPECT_EQ(record.points.size(), 6u);
}

TEST(DebugRender, drawsTheDepthOfAContactEnlarged) {
  Record record;
  DebugRender debug(record.callbacks());
  const std::vector<RigidState> states(2);
  ContactManifold manifold;
  manifold.num_points = 2;
  manifold.points[0].distance = -0.001f;
  manifold.points[1].distance = 0.002f;
  debug.renderContactDepth(states, Pair{0, 1, 0, 0}, std::span(&manifold, 1), 100.0f);
  ASSERT_EQ(record.lines.size(), 2u);
  EXPECT_NEAR((record.lines[0].second - record.lines[0].first).y(), -0.1f, 1e-6f);
  EXPECT_NEAR((record.lines[1].second - record.lines[1].first).y(), 0.2f, 1e-6f);
  debug.renderContactDepth(states, Pair{0, 5, 0, 0}, std::span(&manifold, 1), 100.0f);  // there is no body 5
  EXPECT_EQ(record.lines.size(), 2u);
}

TEST(DebugRender, drawsEachGeometryInOneBatchAndDefinesItOnce) {
  Record record;
  DebugRender debug(record.callbacks());
  Bodies bodies;
  for (int frame = 0; frame < 3; ++frame) {
    record.batches.clear();
    debug.renderSolids(bodies.states, bodies.collidables);
    ASSERT_EQ(record.batches.size(), 3u);  // spheres, boxes, capsule
    EXPECT_EQ(record.batches[0].second.size(), 3u);
    EXPECT_EQ(record.batches[1].second.size(), 3u);
    EXPECT_EQ(record.batches[2].second.size(), 1u);
    EXPECT_EQ(record.batches[2].second[0].pose.position, Vec3(50, 2, 0));
    EXPECT_EQ(record.batches[2].second[0].body, 5u);
  }
  ASSERT_EQ(record.definitions.size(), 3u);
  for (const auto& [key, count] : record.definitions) EXPECT_EQ(count, 1);

  // A body changes its shape, another is hidden, a third is removed.
  bodies.collidables[0].inline_shape.geometry = Box{Vec3(1, 1, 1)};
  debug.setVisible(1, false);
  bodies.collidables[5] = Collidable();
  record.batches.clear();
  debug.renderSolids(bodies.states, bodies.collidables);
  ASSERT_EQ(record.batches.size(), 2u);
  EXPECT_EQ(record.batches[0].second.size(), 2u);
  EXPECT_EQ(record.batches[1].second.size(), 2u);
  EXPECT_EQ(record.batches[1].second[0].body, 0u);
  for (const auto& [key, count] : record.definitions) EXPECT_EQ(count, 1);
}

TEST(DebugRender, keysOfGeometriesDependOnTypeAndSizesAlone) {
  std::set<uint64_t> keys;
  for (int round = 0; round < 2; ++round) {
    Record record;
    DebugRender debug(record.callbacks());
    std::vector<RigidState> states(4);
    std::vector<Collidable> collidables(4);
    for (Collidable& c : collidables) c.half_extent = Vec3::Ones();
    collidables[0].inline_shape.geometry = Capsule{1.0f, 2.0f};
    collidables[1].inline_shape.geometry = Cylinder{1.0f, 2.0f};
    collidables[2].inline_shape.geometry = Capsule{2.0f, 1.0f};
    collidables[3].inline_shape.geometry = Sphere{1.0f};
    debug.renderSolids(states, collidables);
    for (const auto& entry : record.definitions) keys.insert(entry.first);
  }
  EXPECT_EQ(keys.size(), 4u);
}

TEST(DebugRender, skipsCallbacksThatAreNotSet) {
  DebugRender debug;
  const Bodies bodies;
  const std::vector<uint32_t> island = {0};
  ContactManifold manifold;
  manifold.num_points = 1;
  debug.renderWorld(Vec3::Zero(), Vec3::Ones());
  debug.renderAabb(bodies.states, bodies.collidables);
  debug.renderLocalAxis(bodies.states);
  debug.renderIsland(0, island, bodies.states, bodies.collidables);
  debug.renderContact(bodies.states, Pair{0, 1, 0, 0}, std::span(&manifold, 1));
  debug.renderSolids(bodies.states, bodies.collidables);
  Record record;
  debug.callbacks = record.callbacks();
  debug.renderSolids(bodies.states, bodies.collidables);
  EXPECT_EQ(record.definitions.size(), 3u);
}

TEST(Palette, tellsStatesOfBodiesApart) {
  RigidState state;
  std::set<std::pair<Color, Finish>> looks;
  for (int type = 0; type < kNumMotionTypes; ++type) {
    state.motion_type = static_cast<MotionType>(type);
    looks.insert({bodyLook(state, 0).color, bodyLook(state, 0).finish});
  }
  EXPECT_EQ(looks.size(), static_cast<std::size_t>(kNumMotionTypes));
  state.motion_type = MotionType::Active;
  const Look awake = bodyLook(state, 0), other = bodyLook(state, 1);
  EXPECT_NE(awake.color, other.color);
  EXPECT_GT(awake.color >> 16 & 255, awake.color & 255);  // warm: more red than blue
  state.asleep = true;
  EXPECT_EQ(bodyLook(state, 0).color, bodyLook(state, 1).color);
  EXPECT_LT(bodyLook(state, 0).color >> 16 & 255, bodyLook(state, 0).color & 255);  // cool
}

TEST(Palette, hsvHasTheCornersOfTheColourCircle) {
  EXPECT_EQ(hsvColor(0.0f, 1.0f, 1.0f), 0xffff0000u);
  EXPECT_EQ(hsvColor(1.0f / 3.0f, 1.0f, 1.0f), 0xff00ff00u);
  EXPECT_EQ(hsvColor(2.0f / 3.0f, 1.0f, 1.0f), 0xff0000ffu);
  EXPECT_EQ(hsvColor(0.5f, 1.0f, 1.0f), 0xff00ffffu);
  EXPECT_EQ(hsvColor(0.7f, 0.0f, 1.0f), 0xffffffffu);
}

}  // namespace
}  // namespace pfx
