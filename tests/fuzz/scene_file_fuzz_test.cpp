// Damaged scene files and snapshots: refused with the place, or read as the other scene that they say; never a crash,
// and a world that refuses one is as it was.
#include <gtest/gtest.h>

#include <regex>

#include "pfx/high_level/scene_file/scene_file.h"
#include "pfx/high_level/world/snapshot.h"
#include "samples/scene.h"
#include "tests/fuzz/damage.h"

namespace {

using namespace pfx;

World sampleWorld(std::string_view target) {
  const samples::SceneEntry& entry = *samples::findScenes(target).front();
  World world(entry.world);
  entry.make()->build(world);
  return world;
}

// Runs every damaged copy through `load`; returns how many were refused.
template <class Failure, class Load>
int countRefused(const std::string& good, const std::regex& place, Load&& load) {
  int refused = 0;
  for (int n = 0; n < fuzz::kDamagedFiles; ++n) {
    World target;
    target.addBody({.name = "witness", .pose = {.position = Vec3(1.0f, 2.0f, 3.0f)}, .shapes = {Shape{Sphere{}, {}}}});
    const uint64_t before = target.stateHash();
    try {
      load(fuzz::damaged(good, n), target);
      target.step(1.0f / 60.0f);
    } catch (const Failure& e) {
      ++refused;
      EXPECT_TRUE(std::regex_search(e.what(), place)) << n << ": " << e.what();
      EXPECT_EQ(target.stateHash(), before) << n;
      EXPECT_EQ(target.name(0), "witness") << n;
    }
  }
  return refused;
}

class DamagedFile : public testing::TestWithParam<const char*> {};

TEST_P(DamagedFile, OfASceneIsRefusedWithItsLineOrReadAsWhatItSays) {
  const std::string good = writeScene(sampleWorld(GetParam()));
  const int refused = countRefused<SceneError>(good, std::regex("^damaged.xml:[0-9]+: "),
                                               [](const std::string& bad, World& world) {
                                                 loadScene(SceneText{.xml = bad, .name = "damaged.xml"}, world);
                                               });
  EXPECT_GE(refused, fuzz::kDamagedFiles / 2) << "at least those that were cut off";
}

TEST_P(DamagedFile, OfASnapshotIsAlwaysRefusedWithItsSection) {
  World world = sampleWorld(GetParam());
  for (int i = 0; i < 20; ++i) world.step(1.0f / 60.0f);
  std::string good(world.snapshotBytes(), '\0');
  world.snapshot(std::as_writable_bytes(std::span(good)));
  const int refused = countRefused<SnapshotError>(good, std::regex("^snapshot: .+"), [](const std::string& bad, World& w) {
    w.restore(std::as_bytes(std::span(bad)));
  });
  EXPECT_EQ(refused, fuzz::kDamagedFiles);
}

INSTANTIATE_TEST_SUITE_P(Scenes, DamagedFile,
                         testing::Values("1_simple/primitives", "3_sleep/landscape", "11_xml_import/example"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           for (char& c : name)
                             if (c == '/') c = '_';
                           return name;
                         });

}  // namespace
