// Sample 5_raycast: what its scenes claim holds in every frame.
#include <gtest/gtest.h>

#include "samples/scene.h"

namespace {

using namespace samples;

double reading(const Scene& scene, const pfx::World& world, std::string_view name) {
  for (const Reading& r : scene.readings(world))
    if (r.name == name) return r.value;
  ADD_FAILURE() << "no reading " << name;
  return 0.0;
}

// Calls check(scene, world) before the first step and after each one.
template <class Check>
void run(std::string_view target, int steps, Check&& check) {
  const auto found = findScenes(target);
  ASSERT_EQ(found.size(), 1u);
  pfx::World world(found[0]->world);
  const auto scene = found[0]->make();
  scene->build(world);
  for (int i = 0;; ++i) {
    check(*scene, world);
    if (i == steps || testing::Test::HasFailure()) return;
    world.step(kTimeStep);
  }
}

TEST(RaycastSample, everyRayFromTheRingHitsSomethingOnItsSurface) {
  for (const auto target : {"5_raycast/primitives", "5_raycast/landscape"}) {
    SCOPED_TRACE(target);
    run(target, 240, [](const Scene& scene, const pfx::World& world) {
      EXPECT_EQ(reading(scene, world, "rays that hit"), 100.0);
      EXPECT_LT(reading(scene, world, "farthest hit from its surface"), 1e-4);
    });
  }
}

TEST(RaycastSample, everyRayHitsThePlateOfItsFilterAndTheFifthNone) {
  run("5_raycast/filter", 300, [](const Scene& scene, const pfx::World& world) {
    EXPECT_EQ(reading(scene, world, "rays that hit"), 4.0);
    EXPECT_EQ(reading(scene, world, "wrong plates"), 0.0);
  });
}

TEST(RaycastSample, raysSeeTheBoxesInTheAreaAndNoOthers) {
  run("5_raycast/area", 120, [](const Scene& scene, const pfx::World& world) {
    const double hits = reading(scene, world, "rays that hit");
    EXPECT_GT(hits, 20.0);
    EXPECT_LT(hits, 60.0);
    EXPECT_EQ(reading(scene, world, "hits outside the area"), 0.0);
  });
}

}  // namespace
