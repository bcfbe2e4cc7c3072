// The draw list and the recorder: what the engine's callbacks become, without any graphics library.
#include "viewer/draw_list/draw_list.h"

#include <gtest/gtest.h>

#include <numbers>

#include "viewer/draw_list/recorder.h"

namespace viewer {
namespace {

using pfx::Finish;
using pfx::Quat;
using pfx::SolidInstance;
using pfx::Vec3;

std::vector<SolidInstance> rowOfBodies(uint32_t count) {
  std::vector<SolidInstance> row;
  for (uint32_t i = 0; i < count; ++i)
    row.push_back({{Vec3(float(i), 0, 0), Quat::Identity()}, 0xff336699u, Finish::Soft, i});
  return row;
}

struct Recording {
  DrawList list;
  Recorder recorder{list};
  pfx::DebugRenderCallbacks c = recorder.callbacks();
  void define(uint64_t key, const pfx::Geometry& geometry) { c.define_solid(c.context, key, geometry); }
  void draw(uint64_t key, std::span<const SolidInstance> bodies) { c.draw_solids(c.context, key, bodies); }
  void frame(std::span<const SolidInstance> boxes) {
    list.begin();
    define(100, pfx::Box{Vec3(1, 2, 3)});
    draw(100, boxes);
    list.end();
  }
};

TEST(DrawList, PrimitivesBecomeInstancesOfUnitMeshesThatCarryTheirSize) {
  Recording r;
  r.list.begin();
  r.define(100, pfx::Sphere{0.5f});
  r.define(101, pfx::Capsule{2.0f, 0.25f});
  r.define(102, pfx::Box{Vec3(1, 2, 3)});
  r.define(103, pfx::Cylinder{0.7f, 0.3f});
  for (const uint64_t key : {100, 101, 102, 103}) r.draw(key, rowOfBodies(2));
  r.list.end();
  const auto& batches = r.list.batches();
  ASSERT_EQ(batches.size(), 3u);
  EXPECT_EQ(batches.at({kRound, Layer::Plain}).instances.size(), 4u);
  EXPECT_EQ(batches.at({kRound, Layer::Plain}).instances[0].scale, Vec3(0, 0.5f, 0.5f));
  EXPECT_EQ(batches.at({kRound, Layer::Plain}).instances[2].scale, Vec3(2, 0.25f, 0.25f));
  EXPECT_EQ(batches.at({kUnitBox, Layer::Plain}).instances[1].scale, Vec3(1, 2, 3));
  EXPECT_EQ(batches.at({kUnitCylinder, Layer::Plain}).instances[0].scale, Vec3(0.7f, 0.3f, 0.3f));
  EXPECT_EQ(batches.at({kUnitBox, Layer::Plain}).instances[1].pick, pickId(PickKind::Body, 1));
}

TEST(DrawList, SolidsThatWereNeverAnnouncedAreIgnored) {
  Recording r;
  r.list.begin();
  r.draw(77, rowOfBodies(3));
  r.list.end();
  EXPECT_EQ(r.list.numInstances(), 0u);
}

TEST(DrawList, UnchangedInstancesKeepTheirRevisionAndAMovedOneTouchesOnlyItsBlock) {
  Recording r;
  std::vector<SolidInstance> bodies = rowOfBodies(1000);
  r.frame(bodies);
  const std::vector<uint64_t> first = r.list.batches().at({kUnitBox, Layer::Plain}).block_revisions;
  r.frame(bodies);
  EXPECT_EQ(r.list.batches().at({kUnitBox, Layer::Plain}).block_revisions, first);

  bodies[200].pose.position.y() = 1.0f;
  r.frame(bodies);
  const std::vector<uint64_t>& second = r.list.batches().at({kUnitBox, Layer::Plain}).block_revisions;
  ASSERT_EQ(second.size(), first.size());
  for (size_t b = 0; b < first.size(); ++b)
    EXPECT_EQ(second[b] != first[b], b == 200 / Batch::kBlock) << "block " << b;
}

TEST(DrawList, BodiesThatAreNotRecordedAgainDisappear) {
  Recording r;
  r.frame(rowOfBodies(100));
  r.frame(rowOfBodies(40));
  EXPECT_EQ(r.list.numInstances(), 40u);
  EXPECT_EQ(r.list.batches().at({kUnitBox, Layer::Plain}).block_revisions.size(), 1u);
  r.list.begin();
  r.list.end();
  EXPECT_EQ(r.list.numInstances(), 0u);
}

TEST(DrawList, EqualContentIsEqualAndHashesAlikeWhateverWasShownBefore) {
  Recording a, b;
  a.frame(rowOfBodies(300));
  a.frame(rowOfBodies(50));
  b.frame(rowOfBodies(50));
  EXPECT_TRUE(a.list == b.list);
  EXPECT_EQ(a.list.hash(), b.list.hash());
}

TEST(DrawList, EveryKindOfItemChangesComparisonAndHash) {
  const auto changes = {
      +[](DrawList& l) { l.add(kUnitBox, Instance{}); },
      +[](DrawList& l) {
        l.add(Line{Vec3::Zero(), Vec3::UnitX(), 0xff000000u});
      },
      +[](DrawList& l) {
        l.add(Arrow{Vec3::Zero(), Vec3::UnitX(), 0xff000000u});
      },
      +[](DrawList& l) {
        l.add(Point{Vec3::Zero(), 0xff000000u});
      },
      +[](DrawList& l) {
        l.add(Label{Vec3::Zero(), "text"});
      },
      +[](DrawList& l) {
        l.add(LegendEntry{0xff000000u, "text"});
      },
      +[](DrawList& l) { l.camera.eye.x() += 1.0f; },
      +[](DrawList& l) { l.sun.shadows = false; },
      +[](DrawList& l) { l.scale_bar = true; },
  };
  DrawList plain;
  plain.begin();
  plain.end();
  std::vector<uint64_t> hashes = {plain.hash()};
  for (const auto& change : changes) {
    DrawList changed;
    changed.begin();
    change(changed);
    changed.end();
    EXPECT_FALSE(changed == plain);
    EXPECT_EQ(std::count(hashes.begin(), hashes.end(), changed.hash()), 0);
    hashes.push_back(changed.hash());
  }
}

TEST(DrawList, AnAabbBecomesItsTwelveEdges) {
  Recording r;
  r.list.begin();
  r.c.aabb(r.c.context, Vec3(1, 2, 3), Vec3(0.5f, 1.0f, 1.5f), 0xff112233u);
  r.list.end();
  ASSERT_EQ(r.list.lines().size(), 12u);
  double total = 0.0;
  for (const Line& l : r.list.lines()) {
    total += double((l.to - l.from).norm());
    for (const Vec3& p : {l.from, l.to}) EXPECT_EQ((p - Vec3(1, 2, 3)).cwiseAbs(), Vec3(0.5f, 1.0f, 1.5f));
  }
  EXPECT_DOUBLE_EQ(total, 4.0 * (1.0 + 2.0 + 3.0));
}

TEST(DrawList, AnArcIsAPolylineOnItsCircleFromStartToEnd) {
  Recording r;
  r.list.begin();
  const float quarter = std::numbers::pi_v<float> / 2;
  r.c.arc(r.c.context, Vec3(1, 0, 0), Vec3::UnitY(), Vec3::UnitX(), 2.0f, 0.0f, quarter, 0xff000000u);
  r.list.end();
  const auto lines = r.list.lines();
  ASSERT_EQ(lines.size(), 12u);  // 90 degrees in chords of 7.5
  // Counter-clockwise about +Y: from +X towards -Z. 1e-6: rounding of coordinates near 2.
  EXPECT_LT((lines.front().from - Vec3(3, 0, 0)).norm(), 1e-6f);
  EXPECT_LT((lines.back().to - Vec3(1, 0, -2)).norm(), 1e-6f);
  for (size_t i = 0; i < lines.size(); ++i) {
    EXPECT_NEAR((lines[i].to - Vec3(1, 0, 0)).norm(), 2.0f, 1e-6f);
    EXPECT_EQ(lines[i].from, i > 0 ? lines[i - 1].to : lines[i].from);
  }
}

TEST(DrawList, AnArcWithoutFiniteAnglesDrawsNothing) {
  DrawList list;
  list.begin();
  addArc(list,
         {Vec3::Zero(), Vec3::UnitY(), Vec3::UnitX(), 1.0f, 0.0f, std::numeric_limits<float>::infinity()},
         {});
  EXPECT_TRUE(list.lines().empty());
}

TEST(DrawList, LayersFollowFinishTransparencyAndSize) {
  Instance i;
  EXPECT_EQ(layerOf(i), Layer::Plain);
  i.finish = uint32_t(Finish::Metallic);
  EXPECT_EQ(layerOf(i), Layer::Shiny);
  i.color = 0x80ffffffu;
  EXPECT_EQ(layerOf(i), Layer::Translucent);
  i = {};
  i.finish = uint32_t(Finish::Matte);
  EXPECT_EQ(layerOf(i), Layer::Plain);
  i.scale = Vec3(50, 0.5f, 50);
  EXPECT_EQ(layerOf(i), Layer::Floor);
}

}  // namespace
}  // namespace viewer
