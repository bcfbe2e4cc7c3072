// Each scene runs the stages that its content needs and enters no other.
#include <gtest/gtest.h>

#include <set>

#include "tests/files/scene_run.h"

namespace {

using namespace pfx;
using samples::RunningScene;
using samples::SceneEntry;

// What a world had in it at some time of its run.
struct Content {
  bool several_bodies = false, pairs = false, contacts = false, joints = false, scripted = false, particles = false, meshes = false;
  bool sleepers = false, dynamic = false;

  void add(const World& world) {
    const WorldCounts n = world.counts();
    several_bodies |= n.bodies > 1, pairs |= n.pairs > 0, contacts |= n.touching_pairs > 0, joints |= n.joints > 0;
    particles |= world.numParticleSystems() > 0;
    for (const Collidable& body : world.collidables())
      for (const Shape& shape : body.shapes()) meshes |= shape.type() == ShapeType::LargeMesh;
    for (const RigidState& s : world.states()) {
      sleepers |= s.asleep;
      dynamic |= isDynamic(s.motion_type);
      scripted |= s.motion_type == MotionType::Keyframe || s.motion_type == MotionType::Trigger;
    }
  }
};

// What must have been there for a stage to be entered.
bool isAllowed(std::string_view stage, const Content& c, const WorldDef& def) {
  if (stage == "broad phase") return c.several_bodies;
  if (stage == "collision" || stage == "constraints" || stage == "continuous") return c.pairs;
  if (stage == "joints" || stage == "joint components" || stage == "break joints") return c.joints;
  if (stage == "free flight") return c.dynamic;
  if (stage == "solver set-up" || stage == "solve" || stage == "write back") return c.contacts || c.joints;
  if (stage == "store impulses" || stage == "choose solvers" || stage == "island solver") return c.contacts;
  if (stage == "key frames") return c.scripted;
  if (stage == "particles") return c.particles;
  if (stage == "moving meshes") return c.meshes;
  if (stage == "wake" || stage == "sleep") return def.sleeping && c.dynamic;
  if (stage == "events" || stage == "approaches") return def.report_events;
  return false;  // "modified impulses": no scene here changes contacts
}

class SceneStages : public testing::TestWithParam<SceneEntry> {};

TEST_P(SceneStages, AreThoseOfItsContentAndNoOther) {
  RunningScene run(GetParam());
  Content content;
  std::set<std::string_view> entered;  // step by step, as the timer saw them
  content.add(run.world);
  for (int i = 0; i < 60; ++i) {
    run.step();
    content.add(run.world);
    for (const StageTime& t : run.world.stageTimes()) entered.insert(t.name);
  }
  const auto reported = run.world.stages();
  EXPECT_EQ(std::set<std::string_view>(reported.begin(), reported.end()), entered);
  for (std::string_view stage : reported) EXPECT_TRUE(isAllowed(stage, content, GetParam().world)) << stage;
  EXPECT_EQ(entered.contains("particles"), content.particles);
  EXPECT_EQ(entered.contains("joints"), content.joints);
}

INSTANTIATE_TEST_SUITE_P(All, SceneStages, testing::ValuesIn(samples::scenes().begin(), samples::scenes().end()),
                         [](const auto& scene) { return samples::testName(scene.param); });

}  // namespace
