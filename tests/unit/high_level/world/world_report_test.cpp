// What a world tells about its solvers and its broad phase.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "pfx/high_level/world/world.h"

namespace pfx {
namespace {

constexpr float kDt = 1.0f / 60.0f;

BodyId addBox(World& world, const Vec3& at, float mass = 1.0f) {
  return world.addBody(
      {.pose = {.position = at}, .shapes = {{Box{Vec3::Constant(0.5f)}}}, .mass = mass});
}

void addGround(World& world) {
  world.addBody({.pose = {.position = Vec3(0, -1, 0)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {{Box{Vec3(50, 1, 50)}}}});
}

// A heavy box on a light one, which Newton's method takes; and one alone, which it leaves.
World strainedWorld() {
  World world;
  addGround(world);
  addBox(world, Vec3(0, 0.5f, 0));
  addBox(world, Vec3(0, 1.5f, 0), 1000.0f);
  addBox(world, Vec3(5, 0.5f, 0));
  return world;
}

TEST(WorldReport, IslandsTellWhichSolverTookTheirContacts) {
  World world = strainedWorld();
  for (int i = 0; i < 60; ++i) world.step(kDt);
  ASSERT_EQ(world.numIslands(), 2u);
  EXPECT_TRUE(world.islandSolvers(0).newton);
  EXPECT_FALSE(world.islandSolvers(1).newton);
  EXPECT_FALSE(world.islandSolvers(0).direct_joints || world.islandSolvers(0).soft_joints);
}

TEST(WorldReport, TheContactSolverChangesWhileTheWorldRuns) {
  World world = strainedWorld();
  for (int i = 0; i < 60; ++i) world.step(kDt);
  SolverSettings settings = world.solver();
  settings.contact_solver = ContactSolver::Soft;
  world.setSolver(settings);
  world.step(kDt);
  ASSERT_EQ(world.numIslands(), 2u);
  EXPECT_FALSE(world.islandSolvers(0).newton);
}

TEST(WorldReport, TheJointSolverChangesWhileTheWorldRuns) {
  World world;
  const BodyId a = addBox(world, Vec3(0, 5, 0)), b = addBox(world, Vec3(0, 3.5f, 0));
  world.addJoint({.body_a = a, .body_b = b, .params = BallJointParams{.anchor_point = Vec3(0, 4.25f, 0)}});
  world.step(kDt);
  ASSERT_EQ(world.numIslands(), 1u);
  EXPECT_TRUE(world.islandSolvers(0).direct_joints);
  world.setSolver({.substeps = 2, .joint_solver = JointSolver::Soft});
  world.step(kDt);
  ASSERT_EQ(world.numIslands(), 1u);
  EXPECT_TRUE(world.islandSolvers(0).soft_joints);
  EXPECT_FALSE(world.islandSolvers(0).direct_joints);
}

// A light pair hangs from a direct solve until it touches the ground, and is solved by soft rows beside contacts.
TEST(WorldReport, JointsBesideContactsAreToldAsTheSoftRowsThatTheyAre) {
  World world;
  addGround(world);
  const BodyId a = addBox(world, Vec3(0, 2, 0)), b = addBox(world, Vec3(0, 0.8f, 0));
  world.addJoint({.body_a = a, .body_b = b, .params = BallJointParams{.anchor_point = Vec3(0, 1.4f, 0)}});
  world.step(kDt);
  EXPECT_TRUE(world.islandSolvers(0).direct_joints);
  EXPECT_FALSE(world.islandSolvers(0).soft_joints);
  for (int i = 0; i < 30; ++i) world.step(kDt);
  EXPECT_TRUE(world.islandSolvers(0).soft_joints);
  EXPECT_FALSE(world.islandSolvers(0).direct_joints);
}

TEST(WorldReport, SubStepsThatAreSetActLikeThoseOfTheDefinition) {
  World set = World({.substeps = 4}), made = World({.substeps = 9});
  for (World* world : {&set, &made}) addGround(*world), addBox(*world, Vec3(0, 0.6f, 0));
  set.setSolver({.substeps = 9});
  for (int i = 0; i < 30; ++i) set.step(kDt), made.step(kDt);
  EXPECT_EQ(set.stateHash(), made.stateHash());
  EXPECT_THROW(set.setSolver({.substeps = 0}), std::invalid_argument);
}

TEST(WorldReport, TreeBoxesHoldEveryBodyAndSimpleWorldsSweep) {
  World world = strainedWorld();
  world.step(kDt);
  const std::vector<TreeBox> boxes = world.treeBoxes();
  EXPECT_EQ(std::count_if(boxes.begin(), boxes.end(), [](const TreeBox& b) { return b.is_leaf; }), 4);
  EXPECT_EQ(world.sweepAxis(), -1);

  World simple({.pipeline = Pipeline::Simple});
  for (int i = 0; i < 5; ++i) addBox(simple, Vec3(0, 3.0f * float(i), 0));
  simple.step(kDt);
  EXPECT_TRUE(simple.treeBoxes().empty());
  EXPECT_EQ(simple.sweepAxis(), 1);
}

}  // namespace
}  // namespace pfx
