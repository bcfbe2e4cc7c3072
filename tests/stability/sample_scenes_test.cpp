// What each scene of samples 1 to 4 and of the tutorial is there to show, measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "samples/shared/builders.h"
#include "tests/files/scene_run.h"

namespace {

using namespace pfx;
using namespace samples;

RunningScene sceneOf(std::string_view target) { return RunningScene(*findScenes(target).front()); }

void run(RunningScene& scene, int steps) {
  for (int i = 0; i < steps; ++i) scene.step();
}

float fastest(const World& world) {
  float speed = 0.0f;
  for (const RigidState& s : world.states())
    if (isDynamic(s.motion_type))
      speed = std::max({speed, s.linear_velocity.norm(), s.angular_velocity.norm()});
  return speed;
}

float lowest(const World& world) {
  float y = 1e9f;
  for (const RigidState& s : world.states())
    if (isDynamic(s.motion_type)) y = std::min(y, s.position.y());
  return y;
}

double reading(const RunningScene& scene, std::string_view name) {
  for (const Reading& r : scene.scene->readings(scene.world))
    if (r.name == name) return r.value;
  throw std::logic_error("no such reading: " + std::string(name));
}

double stageMs(const World& world) {
  double sum = 0.0;
  for (const StageTime& t : world.stageTimes()) sum += t.milliseconds;
  return sum;
}

// Of the highest ring of a small tower after two seconds.
float sagOfTower(float dt, int substeps) {
  World world({.substeps = substeps});
  addGround(world);
  addTower(world, {});
  const float top = world.states().back().position.y();
  for (float t = 0.0f; t < 1.999f; t += dt) world.step(dt);
  return top - world.states().back().position.y();
}

TEST(SimpleAndStable, OnlyTheSecondRemembersItsContacts) {
  const auto rememberedImpulses = [](Pipeline pipeline) {
    World world({.pipeline = pipeline});
    addGround(world);
    addTower(world, {.layers = 2});
    for (int i = 0; i < 30; ++i) world.step(kTimeStep);
    double sum = 0.0;
    for (const Pair& pair : world.contactPairs())
      for (const ContactManifold& m : world.manifolds(pair))
        for (int i = 0; i < m.num_points; ++i) sum += static_cast<double>(m.points[i].normal_impulse);
    return sum;
  };
  EXPECT_EQ(rememberedImpulses(Pipeline::Simple), 0.0);
  // 48 boxes of 0.5 kg, of which the ground carries all and the lower ring half, for one sub-step or step.
  EXPECT_GT(rememberedImpulses(Pipeline::Stable), 36.0 * 9.8 / 240.0 * 0.9);
}

// SM-03: without any memory as well.
TEST(SimpleAndStable, PrimitivesRestOnTheGroundAfterTenSeconds) {
  for (const char* target : {"1_simple/primitives", "2_stable/primitives"}) {
    RunningScene scene = sceneOf(target);
    ASSERT_EQ(scene.world.counts().awake, 6u);
    run(scene, 600);
    std::printf("%s: fastest %.1e m/s or rad/s after 10 s\n", target, static_cast<double>(fastest(scene.world)));
    RecordProperty("fastest", std::to_string(fastest(scene.world)));
    EXPECT_LT(fastest(scene.world), 0.01f) << target;
    EXPECT_GT(lowest(scene.world), 0.45f) << target;
  }
}

TEST(SimpleAndStable, HangingBoxesStayOnTheirJointsForTwentySeconds) {
  for (const char* sample : {"1_simple/joints", "2_stable/joints"}) {
    RunningScene scene = sceneOf(sample);
    double error = 0.0;
    for (int i = 0; i < 1200; ++i) {
      scene.step();
      for (uint32_t k = 0; k < scene.world.joints().size(); ++k)
        error = std::max(error, static_cast<double>(scene.world.jointError(k).distance));
    }
    RecordProperty("joint_error_mm", std::to_string(1e3 * error));
    EXPECT_LT(error, 0.05) << sample;
    EXPECT_LT(fastest(scene.world), 10.0f) << sample;
  }
}

TEST(SimpleAndStable, OnTheLandscapeNothingFallsThrough) {
  for (const char* sample : {"1_simple/landscape", "2_stable/landscape", "3_sleep/landscape"}) {
    RunningScene scene = sceneOf(sample);
    for (int i = 0; i < 600; ++i) {
      scene.step();
      // Its lowest point: 2 m below the origin, less waves of 0.8 m and 14 m at a slope of 0.06.
      ASSERT_GT(lowest(scene.world), -3.7f) << sample << ", step " << i;
    }
  }
}

TEST(Stable, ASmallerStepSagsLess) {
  const float sag[] = {sagOfTower(1.0f / 60.0f, 4), sagOfTower(1.0f / 120.0f, 4),
                       sagOfTower(1.0f / 240.0f, 4)};
  for (int i = 0; i < 3; ++i) RecordProperty("sag_um_" + std::to_string(i), std::to_string(1e6f * sag[i]));
  EXPECT_GT(sag[0], sag[1]);
  EXPECT_GT(sag[1], sag[2]);
}

TEST(Stable, MoreSubStepsSagLess) {
  float last = 1e9f;
  for (const int substeps : {3, 5, 10, 20}) {
    const float sag = sagOfTower(1.0f / 60.0f, substeps);
    RecordProperty("sag_um_" + std::to_string(substeps), std::to_string(1e6f * sag));
    EXPECT_LT(sag, last) << substeps;
    last = sag;
  }
}

class SleepScenes : public testing::TestWithParam<const char*> {};

TEST_P(SleepScenes, AllBodiesSleepAfterTwentySecondsAndCostNothing) {
  RunningScene scene = sceneOf("3_sleep/" + std::string(GetParam()));
  run(scene, 60);
  double awake = 1e9, asleep = 1e9;
  for (int i = 0; i < 20; ++i) scene.step(), awake = std::min(awake, stageMs(scene.world));
  run(scene, 1120);
  EXPECT_EQ(scene.world.counts().awake, 0u);
  for (int i = 0; i < 20; ++i) scene.step(), asleep = std::min(asleep, stageMs(scene.world));
  std::printf("3_sleep/%s: %.1f us a step awake, %.1f us asleep\n", GetParam(), 1e3 * awake, 1e3 * asleep);
  RecordProperty("awake_us", std::to_string(1e3 * awake));
  RecordProperty("asleep_us", std::to_string(1e3 * asleep));
  EXPECT_LT(asleep, 0.2 * awake);
}

INSTANTIATE_TEST_SUITE_P(All, SleepScenes,
                         testing::Values("primitives", "joints", "tower", "pyramid", "landscape", "walls"),
                         [](const auto& p) { return std::string(p.param); });

TEST(Sleep, TheBallWakesTheWallThatItHitsAndNoOther) {
  RunningScene scene = sceneOf("3_sleep/walls");
  run(scene, 300);
  ASSERT_EQ(scene.world.counts().awake, 0u);
  uint32_t most = 0;
  for (int i = 0; i < 120; ++i) {
    scene.step();
    uint32_t walls_awake = 0;  // wall k: 28 boxes from body 1 + 28 k
    for (uint32_t wall = 0; wall < 9; ++wall) walls_awake += !scene.world.states()[1 + 28 * wall].asleep;
    most = std::max(most, walls_awake);
  }
  EXPECT_EQ(most, 1u);
}

TEST(Sleep, ComesAfterTheGivenNumberOfStepsBelowTheGivenSpeed) {
  const auto asleepAfter = [](uint32_t steps, float velocity, float speed) {
    World world({.sleeping = true, .sleep_velocity = velocity, .sleep_steps = steps});
    world.addBody(
        {.linear_velocity = Vec3(speed, 0.0f, 0.0f), .shapes = {shape(Sphere{0.5f})}, .gravity_scale = 0.0f});
    uint32_t n = 0;
    while (!world.states()[0].asleep && n < 1000) world.step(kTimeStep), ++n;
    return n;
  };
  EXPECT_EQ(asleepAfter(180, 0.1f, 0.09f), 181u);
  EXPECT_EQ(asleepAfter(60, 0.1f, 0.09f), 61u);
  EXPECT_EQ(asleepAfter(180, 0.1f, 0.11f), 1000u);
  EXPECT_EQ(asleepAfter(180, 0.2f, 0.11f), 181u);
}

TEST(MotionType, TheKeyframeBarNeverDeviatesAndSweepsTheWallAway) {
  RunningScene scene = sceneOf("4_motion_type/keyframe");
  uint32_t bar = 0;
  while (scene.world.name(bar) != "bar") ++bar;
  double off = 0.0;
  for (int i = 0; i < 240; ++i) {
    scene.scene->beforeStep(scene.world, kTimeStep);
    ASSERT_NEAR(scene.world.states()[bar].angular_velocity.y(), 0.02f * 60.0f, 1e-4f) << "held as a velocity";
    scene.world.step(kTimeStep);
    off = std::max(off, reading(scene, "bar off its path"));
  }
  EXPECT_LT(off, 1e-2) << "mm";
  EXPECT_GT(reading(scene, "farthest box of the wall"), 2.0);
}

TEST(MotionType, TheOneWayBarMovesNothingAndTheActiveOneKnocksItsWallOver) {
  RunningScene scene = sceneOf("4_motion_type/one_way");
  double one_way = 0.0;
  for (int i = 0; i < 400; ++i) {
    scene.step();
    one_way = std::max(one_way, reading(scene, "wall of the one-way bar moved"));
  }
  RecordProperty("one_way_mm", std::to_string(1e3 * one_way));
  RecordProperty("active_m", std::to_string(reading(scene, "wall of the active bar moved")));
  EXPECT_LT(one_way, 0.01);
  EXPECT_GT(reading(scene, "wall of the active bar moved"), 0.5);
}

TEST(MotionType, TheTriggerNoticesBothBoxesAndChangesNoVelocity) {
  RunningScene with = sceneOf("4_motion_type/trigger"), without = sceneOf("4_motion_type/trigger");
  uint32_t trigger = 0;
  while (without.world.name(trigger) != "trigger") ++trigger;
  without.world.removeBody(without.world.bodyId(trigger));
  for (int i = 0; i < 300; ++i) {
    with.step();
    without.world.step(kTimeStep);
    for (uint32_t k = 0; k < with.world.states().size(); ++k) {
      if (k == trigger) continue;
      ASSERT_EQ(with.world.states()[k].linear_velocity, without.world.states()[k].linear_velocity) << i;
      ASSERT_EQ(with.world.states()[k].position, without.world.states()[k].position) << i;
    }
  }
  EXPECT_GE(reading(with, "passages of the active box"), 2.0);
  EXPECT_GE(reading(with, "passages of the one-way box"), 2.0);
}

TEST(Tutorial, EverySceneRunsSixHundredSteps) {
  for (const SceneEntry* entry : findScenes("tutorial")) {
    RunningScene scene(*entry);
    run(scene, 600);
    for (const RigidState& s : scene.world.states()) ASSERT_TRUE(s.position.allFinite()) << entry->name;
    for (const Reading& r : scene.scene->readings(scene.world)) {
      RecordProperty(std::string(entry->name) + ": " + std::string(r.name), std::to_string(r.value));
      if (r.limit > 0.0) {
        EXPECT_LE(r.value, r.limit) << entry->name << ": " << r.name;
      }
    }
  }
}

TEST(Tutorial, TheTownIsOneMeshOfTwoThousandTrianglesAndCarriesItsRain) {
  RunningScene scene = sceneOf("tutorial/town");
  EXPECT_GT(reading(scene, "triangles of the town"), 1900.0);
  EXPECT_LT(reading(scene, "triangles of the town"), 2300.0);
  for (int i = 0; i < 600; ++i) {
    scene.step();
    ASSERT_EQ(reading(scene, "bodies below the ground"), 0.0) << "step " << i;
  }
}

TEST(Tutorial, RaysHitOnlyWhatLiesInTheirArea) {
  RunningScene scene = sceneOf("tutorial/town_rays");
  double hits = 0.0, on_bodies = 0.0;
  for (int i = 0; i < 300; ++i) {
    scene.step();
    ASSERT_EQ(reading(scene, "hits outside of the area"), 0.0) << "step " << i;
    hits += reading(scene, "rays that hit, of 50");
    on_bodies += reading(scene, "rays that hit a body");
  }
  EXPECT_GT(hits / 300.0, 20.0);
  EXPECT_GT(on_bodies, 100.0);
}

TEST(Tutorial, PlacesOfRemovedBodiesAreUsedAgain) {
  RunningScene scene = sceneOf("tutorial/primitives");
  run(scene, 1800);
  EXPECT_EQ(reading(scene, "bodies replaced"), 60.0);
  EXPECT_EQ(reading(scene, "valid handles, of 24"), 24.0);
  EXPECT_EQ(reading(scene, "places in the arrays"), 29.0);
}

}  // namespace
