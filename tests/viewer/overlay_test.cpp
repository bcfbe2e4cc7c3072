// Overlays: each one draws something of its own, all of them together draw at once, and off they cost nothing.
#include <gtest/gtest.h>

#include "pfx/util/mesh_builder/mesh_builder.h"
#include "viewer/input_error.h"
#include "viewer/run/scene_run.h"
#include "viewer/run/world_view.h"

namespace viewer {
namespace {

using pfx::Vec3;

// A ball and a sliding box on a mesh, a hinge with limits and a cone joint that hang from a fixed body.
struct Everything {
  pfx::World world;
  pfx::BodyId box;

  Everything() {
    const std::vector<Vec3> corners = {Vec3(-5, 0, -5), Vec3(5, 0.2f, -5), Vec3(5, 0, 5), Vec3(-5, 0.3f, 5)};
    const std::vector<uint32_t> faces = {0, 2, 1, 0, 3, 2};
    pfx::LargeMesh mesh = std::move(pfx::buildLargeMesh(corners, faces).mesh);
    const pfx::BodyId ground = world.addBody({.name = "ground",
                                              .motion_type = pfx::MotionType::Fixed,
                                              .shapes = {{world.keep(std::move(mesh))}}});
    world.addBody({.name = "ball", .pose = {.position = Vec3(0, 0.7f, 0)}, .shapes = {{pfx::Sphere{0.5f}}}});
    box = world.addBody({.name = "box",
                         .pose = {.position = Vec3(2, 0.7f, 1)},
                         .linear_velocity = Vec3(1, 0, 0),
                         .shapes = {{pfx::Box{Vec3::Constant(0.5f)}}}});
    const auto hang = [&](float x) {
      return world.addBody({.pose = {.position = Vec3(x, 3, -2)}, .shapes = {{pfx::Box{Vec3(0.2f, 0.5f, 0.2f)}}}});
    };
    world.addJoint({.name = "hinge",
                    .body_a = ground,
                    .body_b = hang(-2),
                    .params = pfx::HingeJointParams{.anchor_point = Vec3(-2, 3.5f, -2),
                                                    .axis = Vec3::UnitX(),
                                                    .lower_angle = -0.5f,
                                                    .upper_angle = 0.5f}});
    world.addJoint({.name = "cone",
                    .body_a = ground,
                    .body_b = hang(0),
                    .params = pfx::SwingTwistJointParams{.anchor_point = Vec3(0, 3.5f, -2), .twist_axis = Vec3::UnitY()}});
    world.addParticles({.name = "net",
                        .positions = {Vec3(3, 3, 0), Vec3(3.5f, 3, 0), Vec3(4, 3, 0), Vec3(3.5f, 3.5f, 0), Vec3(3.5f, 3, 1)},
                        .masses = {0.0f, 1.0f, 1.0f, 1.0f, 1.0f},
                        .strands = {{.particles = {0, 1, 2}}},
                        .distances = {{.a = 1, .b = 3}},
                        .angles = {{.a = 0, .b = 1, .c = 2}},
                        .volumes = {{.a = 0, .b = 1, .c = 3, .d = 4}}});
    for (int i = 0; i < 20; ++i) world.step(1.0f / 60.0f);
  }

  ViewExtras extras() const {
    ViewExtras e;
    e.probe = ProbeRay{Vec3(0, 8, 3), Vec3(0, -16, -6)};
    return e;
  }

  DrawList drawn(const Overlays& overlays, const ViewExtras& extras = {}) const {
    DrawList list;
    WorldView view(list);
    list.begin();
    list.camera = orbitCamera({.target = Vec3(0, 1, 0), .distance = 15});
    view.add(world, overlays, extras);
    list.end();
    return list;
  }
};

size_t numItems(const DrawList& list) {
  return list.lines().size() + list.arrows().size() + list.points().size() + list.labels().size();
}

Trails someTrails(const pfx::World& world) {
  Trails trails(3);
  for (size_t step = 0; step < trails.size(); ++step)
    for (const pfx::RigidState& s : world.states()) trails[step].push_back(s.position + Vec3(0, 0.1f * float(step), 0));
  return trails;
}

TEST(Overlays, EachOneDrawsSomethingOfItsOwnAndOffItDrawsNothing) {
  const Everything e;
  const Trails trails = someTrails(e.world);
  ViewExtras extras = e.extras();
  extras.trails = &trails;
  const DrawList plain = e.drawn({}, extras);
  EXPECT_EQ(numItems(plain), 0u);
  std::vector<uint64_t> hashes = {plain.hash()};
  for (const OverlayInfo& info : overlayTable()) {
    Overlays one;
    one.*info.flag = true;
    if (info.flag == &Overlays::selection_only) continue;
    const DrawList list = e.drawn(one, extras);
    EXPECT_EQ(std::count(hashes.begin(), hashes.end(), list.hash()), 0) << info.name;
    EXPECT_GT(numItems(list), 0u) << info.name;
    hashes.push_back(list.hash());
  }
}

TEST(Overlays, TogetherTheyDrawWhatEachDrawsAlone) {
  const Everything e;
  const Trails trails = someTrails(e.world);
  ViewExtras extras = e.extras();
  extras.trails = &trails;
  size_t alone = 0;
  for (const OverlayInfo& info : overlayTable()) {
    Overlays one;
    one.*info.flag = true;
    // Edges are part of the thickness; alone, both draw them.
    if (info.flag != &Overlays::mesh_edges) alone += numItems(e.drawn(one, extras));
  }
  EXPECT_EQ(numItems(e.drawn(parseOverlays("all"), extras)), alone);
}

TEST(Overlays, OfTheSelectionAloneAreThoseOfItsBodies) {
  const Everything e;
  ViewExtras extras;
  extras.selected.assign(e.world.states().size(), 0);
  extras.selected[e.box.index] = 1;
  Overlays o;
  o.selection_only = o.names = o.aabb = true;
  const DrawList list = e.drawn(o, extras);
  ASSERT_EQ(list.labels().size(), 1u);
  EXPECT_EQ(list.labels()[0].text, "box");
  EXPECT_EQ(list.lines().size(), 12u);
  extras.selected.clear();
  EXPECT_EQ(e.drawn(o, extras).labels().size(), 4u) << "without a selection everything is meant";
}

TEST(Overlays, TheProbeFindsWhatARayFinds) {
  const Everything e;
  Overlays o;
  o.probe = true;
  const DrawList list = e.drawn(o, e.extras());
  ASSERT_EQ(list.labels().size(), 1u);
  EXPECT_EQ(list.labels()[0].text.rfind("ball"), list.labels()[0].text.size() - 4) << list.labels()[0].text;
  ASSERT_EQ(list.points().size(), 1u);
  EXPECT_NEAR((list.points()[0].position - e.world.states()[1].position).norm(), 0.5f, 1e-3f) << "on the ball";
}

TEST(Overlays, ASimpleWorldShowsTheAxisOfItsSweep) {
  pfx::World world({.pipeline = pfx::Pipeline::Simple});
  for (int i = 0; i < 3; ++i)
    world.addBody({.pose = {.position = Vec3(0, 0, 3.0f * float(i))}, .shapes = {{pfx::Sphere{0.5f}}}});
  world.step(1.0f / 60.0f);
  DrawList list;
  WorldView view(list);
  Overlays o;
  o.tree = true;
  list.begin();
  view.add(world, o);
  list.end();
  ASSERT_EQ(list.arrows().size(), 3u);
  for (const Arrow& a : list.arrows()) EXPECT_NEAR(a.to.z() - a.from.z(), 1.0f, 1e-4f);
  EXPECT_EQ(list.legend()[0].text, "sweep along z");
}

TEST(Overlays, TheMassBoxOfAUniformBoxIsTheBox) {
  const Everything e;
  Overlays o;
  o.inertia = o.selection_only = true;
  ViewExtras extras;
  extras.selected.assign(e.world.states().size(), 0);
  extras.selected[e.box.index] = 1;
  const DrawList list = e.drawn(o, extras);
  ASSERT_EQ(list.lines().size(), 12u);
  for (const Line& l : list.lines()) EXPECT_NEAR((l.to - l.from).norm(), 1.0f, 1e-4f);  // float inertia
}

TEST(Overlays, NamesAreReadBackAndUnknownOnesRefused) {
  const Overlays some = parseOverlays("limits,mesh_edges,selection");
  EXPECT_TRUE(some.limits && some.mesh_edges && some.selection_only && !some.contacts);
  EXPECT_EQ(parseOverlays(overlayList(some)), some);
  EXPECT_FALSE(parseOverlays("all").selection_only);
  EXPECT_THROW(parseOverlays("limit"), InputError);
}

TEST(WorldView, ColorsOfASceneAreWornByTheBodiesThemselvesSoThatTheyCanBePicked) {
  const Everything e;
  constexpr Color kRed = 0xffc03020;
  ViewExtras extras;
  const DrawList plain = e.drawn({}, extras);
  extras.body_colors.assign(e.world.states().size(), 0);
  extras.body_colors[e.box.index] = kRed;
  const DrawList list = e.drawn({}, extras);
  ASSERT_EQ(list.numInstances(), plain.numInstances());
  for (const auto& [key, batch] : list.batches())
    for (size_t i = 0; i < batch.instances.size(); ++i) {
      const Instance &now = batch.instances[i], &before = plain.batches().at(key).instances[i];
      EXPECT_EQ(now.color, now.pick == pickId(PickKind::Body, e.box.index) ? kRed : before.color);
      EXPECT_EQ(now.pick, before.pick);
    }
}

TEST(WorldView, MarksOfOneTriangleAreDrawnUntilTheyAreTakenBack) {
  const Everything e;
  DrawList list;
  WorldView view(list);
  const auto lines = [&] {
    list.begin();
    view.add(e.world, {});
    list.end();
    return list.lines().size();
  };
  const pfx::MeshTriangleId triangle{.body = 0, .island = 0, .triangle = 1};
  EXPECT_EQ(lines(), 0u);
  view.mark(e.world, triangle, pfx::MeshDraw::Edge | pfx::MeshDraw::Thickness);
  EXPECT_EQ(lines(), 9u);
  EXPECT_EQ(view.markOf(triangle), pfx::MeshDraw::Edge | pfx::MeshDraw::Thickness);
  view.mark(e.world, {.body = 0, .island = 7, .triangle = 0}, pfx::MeshDraw::All);
  EXPECT_EQ(lines(), 9u) << "there is no such island";
  view.mark(e.world, triangle, pfx::MeshDraw::None);
  EXPECT_EQ(lines(), 0u);
}

}  // namespace
}  // namespace viewer
