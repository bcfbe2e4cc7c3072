// Chapter 8: debug rendering. Calls are counted, as the overview promises how many there are.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/compat/scene.h"

using namespace compat_tests;

namespace {

struct Count {
  int points = 0, lines = 0, arcs = 0, aabbs = 0, boxes = 0;
  PfxVector3 last_from, last_to, last_half, last_center;
  PfxFloat arc_start = 0.0f, arc_end = 0.0f;
};
Count count;

void point(const PfxVector3&, const PfxVector3&) { ++count.points; }
void line(const PfxVector3& from, const PfxVector3& to, const PfxVector3&) { ++count.lines, count.last_from = from, count.last_to = to; }
void arc(const PfxVector3&, const PfxVector3&, const PfxVector3&, PfxFloat, PfxFloat start, PfxFloat end, const PfxVector3&) {
  ++count.arcs, count.arc_start = start, count.arc_end = end;
}
void aabb(const PfxVector3& center, const PfxVector3& half, const PfxVector3&) { ++count.aabbs, count.last_center = center, count.last_half = half; }
void box(const PfxTransform3&, const PfxVector3&, const PfxVector3&) { ++count.boxes; }

class CompatDebugRender : public testing::Test {
 protected:
  void SetUp() override {
    render_ = new PfxDebugRender;
    render_->setDebugRenderPointFunc(point);
    render_->setDebugRenderLineFunc(line);
    render_->setDebugRenderArcFunc(arc);
    render_->setDebugRenderAabbFunc(aabb);
    render_->setDebugRenderBoxFunc(box);
    scene_.addBox(PfxVector3(10, 1, 10), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
    for (int i = 0; i < 3; ++i) scene_.addBox(PfxVector3(0.5f), PfxVector3(3.0f * i, 0.499f, 0), kPfxMotionTypeActive);
    render_->resetVisible(4);
    count = Count();
  }
  void TearDown() override { delete render_; }

  PfxDebugRender* render_ = nullptr;
  Scene scene_;
};

TEST_F(CompatDebugRender, BoundsAndAxesOfVisibleBodies) {
  render_->renderWorld(PfxVector3(0.0f), PfxVector3(500.0f));
  EXPECT_EQ(count.aabbs, 1);
  EXPECT_EQ(count.last_half[1], 500.0f);
  render_->renderAabb(scene_.states.data(), scene_.collidables.data(), 4);
  EXPECT_EQ(count.aabbs, 5);
  EXPECT_NEAR(count.last_center[0], 6.0f, 1e-5f);
  render_->setScale(2.0f);
  EXPECT_EQ(render_->getScale(), 2.0f);
  render_->renderLocalAxis(scene_.states.data(), 4);
  EXPECT_EQ(count.lines, 12);
  EXPECT_NEAR(length(count.last_to - count.last_from), 2.0f, 1e-5f);
  count = Count();
  render_->setVisible(2, false);
  EXPECT_FALSE(render_->getVisible(2));
  render_->renderAabb(scene_.collidables.data(), scene_.states.data(), 4u);  // arguments in another order
  render_->renderLocalAxis(scene_.states.data(), 4);
  EXPECT_EQ(count.aabbs, 3);
  EXPECT_EQ(count.lines, 9);
}

TEST_F(CompatDebugRender, ContactsOfVisibleSides) {
  scene_.updatePairs();
  scene_.collide();
  const PfxUInt32 n = static_cast<PfxUInt32>(scene_.contacts.size());
  ASSERT_EQ(n, 3u);
  render_->renderContact(scene_.contacts.data(), n, scene_.states.data());
  EXPECT_EQ(count.points, 2 * 12);
  EXPECT_EQ(count.lines, 2 * 12);
  render_->setVisible(0, false);
  count = Count();
  render_->renderContact(scene_.pairs.data(), n, scene_.contacts.data(), scene_.states.data());
  EXPECT_EQ(count.points, 12);
  EXPECT_NEAR(count.last_to[1] - count.last_from[1], -1.0f, 1e-4f);  // outwards, under the box
}

TEST_F(CompatDebugRender, IslandsOfBodies) {
  scene_.updatePairs();
  Buffer buffer(pfxGetIslandBytesOfGenerateIsland(4));
  PfxGenerateIslandParam param;
  param.islandBuff = buffer.data, param.islandBytes = buffer.bytes;
  param.pairs = scene_.pairs.data(), param.numPairs = static_cast<PfxUInt32>(scene_.pairs.size()), param.numObjects = 4;
  PfxGenerateIslandResult result;
  ASSERT_EQ(pfxGenerateIsland(param, result), SCE_PFX_OK);
  render_->renderIsland(result.island, scene_.states.data(), scene_.collidables.data());
  EXPECT_EQ(count.aabbs, 4);  // the ground connects nothing
}

TEST_F(CompatDebugRender, JointsWithTheirRanges) {
  const PfxRigidState &a = scene_.states[1], &b = scene_.states[2];
  const auto render = [&](const PfxJoint& joint) {
    count = Count();
    render_->renderJoint(&joint, 1, scene_.states.data());
    EXPECT_EQ(count.points, 2);
  };
  PfxJoint joint;
  pfxInitializeBallJoint(joint, a, b, PfxBallJointInitParam());
  render(joint);
  EXPECT_EQ(count.lines, 6);
  EXPECT_EQ(count.arcs, 0);
  PfxHingeJointInitParam hinge;
  hinge.lowerAngle = -0.5f, hinge.upperAngle = 0.7f;
  pfxInitializeHingeJoint(joint, a, b, hinge);
  render(joint);
  EXPECT_EQ(count.lines, 6);
  EXPECT_EQ(count.arcs, 1);
  EXPECT_FLOAT_EQ(count.arc_start, -0.5f);
  EXPECT_FLOAT_EQ(count.arc_end, 0.7f);
  PfxSliderJointInitParam slider;
  slider.lowerDistance = 0.0f, slider.upperDistance = 1.0f;
  pfxInitializeSliderJoint(joint, a, b, slider);
  render(joint);
  EXPECT_EQ(count.lines, 9);
  pfxInitializeSwingTwistJoint(joint, a, b, PfxSwingTwistJointInitParam());
  render(joint);
  EXPECT_EQ(count.arcs, 3);
  pfxInitializeUniversalJoint(joint, a, b, PfxUniversalJointInitParam());
  render(joint);
  EXPECT_EQ(count.arcs, 2);
}

TEST_F(CompatDebugRender, LargeMeshesByFlagFrustumAndMark) {
  const PfxFloat verts[] = {-5, 0, -5, 5, 0, -5, -5, 0, 5, 5, 0, 5};
  const PfxUInt16 triangles[] = {0, 2, 1, 1, 2, 3};
  PfxCreateLargeTriMeshParam param;
  param.verts = verts, param.numVerts = 4, param.triangles = triangles, param.numTriangles = 2;
  PfxLargeTriMesh mesh;
  ASSERT_EQ(pfxCreateLargeTriMesh(mesh, param), SCE_PFX_OK);
  PfxShape shape;
  shape.setLargeTriMesh(&mesh);
  const PfxUInt32 body = scene_.add(shape, PfxVector3(0.0f), kPfxMotionTypeFixed);
  const PfxRigidState* states = scene_.states.data();
  const PfxCollidable* collidables = scene_.collidables.data();
  const auto drawn = [&](PfxUInt32 flag) {
    count = Count();
    render_->renderLargeMesh(states, collidables, 5, flag);
    return count;
  };
  EXPECT_EQ(drawn(SCE_PFX_DRENDER_MESH_FLG_ISLAND).boxes, 1);
  EXPECT_EQ(drawn(SCE_PFX_DRENDER_MESH_FLG_EDGE).lines, 6);
  EXPECT_EQ(drawn(SCE_PFX_DRENDER_MESH_FLG_FACET_AABB).boxes, 2);
  EXPECT_EQ(drawn(SCE_PFX_DRENDER_MESH_FLG_NORMAL).lines, 2);
  EXPECT_EQ(drawn(SCE_PFX_DRENDER_MESH_FLG_THICKNESS).lines, 0);
  EXPECT_EQ(drawn(SCE_PFX_DRENDER_MESH_FLG_EDGE | SCE_PFX_DRENDER_MESH_FLG_THICKNESS).lines, 18);
  EXPECT_EQ(drawn(SCE_PFX_DRENDER_MESH_FLG_ALL).lines, 20);
  EXPECT_EQ(drawn(SCE_PFX_DRENDER_MESH_FLG_ALL).boxes, 3);

  const auto inFrustum = [&](const PfxVector4* planes, PfxUInt32 n) {
    count = Count();
    render_->renderLargeMeshInFrustum(states, collidables, 5, SCE_PFX_DRENDER_MESH_FLG_EDGE, planes, n);
    return count.lines;
  };
  const PfxVector4 inside[] = {PfxVector4(0, 1, 0, 1), PfxVector4(1, 0, 0, 1)};
  const PfxVector4 outside[] = {PfxVector4(0, 1, 0, 1), PfxVector4(0, 1, 0, -20)};
  const PfxVector4 ball(20, 0, 0, 1), large_ball(20, 0, 0, 15);
  EXPECT_EQ(inFrustum(inside, 2), 6);
  EXPECT_EQ(inFrustum(outside, 2), 0);
  EXPECT_EQ(inFrustum(&ball, 1), 0);
  EXPECT_EQ(inFrustum(&large_ball, 1), 6);

  EXPECT_EQ(render_->setLargeMeshFlag(body, 0, 1, SCE_PFX_DRENDER_MESH_FLG_EDGE), SCE_PFX_OK);
  EXPECT_EQ(render_->setLargeMeshFlag(body, 512, 0, SCE_PFX_DRENDER_MESH_FLG_EDGE), SCE_PFX_ERR_OUT_OF_RANGE);
  EXPECT_EQ(render_->setLargeMeshFlag(body, 0, 64, SCE_PFX_DRENDER_MESH_FLG_EDGE), SCE_PFX_ERR_OUT_OF_RANGE);
  EXPECT_EQ(render_->setLargeMeshFlag(body, 0, 0, 0x20), SCE_PFX_ERR_INVALID_FLAG);
  count = Count();
  render_->renderLargeMeshByFlag(states, collidables, 5);
  EXPECT_EQ(count.lines, 3);
  pfxReleaseLargeTriMesh(mesh);
}

TEST(CompatDebugRenderWithout, CallbacksNothingIsDrawn) {
  Scene scene;
  scene.addBox(PfxVector3(0.5f), PfxVector3(0.0f), kPfxMotionTypeActive);
  PfxDebugRender render;
  render.resetVisible(1);
  render.renderWorld(PfxVector3(0.0f), PfxVector3(1.0f));
  render.renderAabb(scene.states.data(), scene.collidables.data(), 1);
  render.renderLocalAxis(scene.states.data(), 1);
  render.renderLargeMesh(scene.states.data(), scene.collidables.data(), 1, SCE_PFX_DRENDER_MESH_FLG_ALL);
  EXPECT_TRUE(render.getVisible(0));
}

}  // namespace
