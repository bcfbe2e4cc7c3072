// Damaged files of serialized arrays: refused with the place, or (where only blanks were changed) read as
// they were.
#include <gtest/gtest.h>

#include "pfx/util/state_hash/state_hash.h"
#include "samples/scene.h"
#include "tests/files/world_arrays.h"
#include "tests/fuzz/damage.h"

namespace {

using namespace pfx;

// Enough room for every scene below, so that a wrong count in a file would be seen as memory asked for.
constexpr SceneCounts kMost{4, 4, 100, 1000, 1000, 1000, 100, 100, 20000, 20000};

bool isWithin(const SceneCounts& n) {
  return n.convex_meshes <= kMost.convex_meshes && n.large_meshes <= kMost.large_meshes &&
         n.shapes <= kMost.shapes && n.states <= kMost.states && n.bodies <= kMost.bodies &&
         n.collidables <= kMost.collidables && n.joints <= kMost.joints &&
         n.joint_pairs <= kMost.joint_pairs && n.contact_pairs <= kMost.contact_pairs &&
         n.manifolds <= kMost.manifolds;
}

class DamagedArrays : public testing::TestWithParam<const char*> {};

TEST_P(DamagedArrays, AreRefusedWithTheirPlaceOrReadAsTheyWere) {
  const samples::SceneEntry& entry = *samples::findScenes(GetParam()).front();
  World world(entry.world);
  entry.make()->build(world);
  for (int i = 0; i < 20; ++i) world.step(1.0f / 60.0f);
  const auto original = files::arraysOf(world);
  const std::string good = files::written(*original);
  int refused = 0;
  for (int n = 0; n < fuzz::kDamagedFiles; ++n) {
    files::SceneVectors target;
    target.states.emplace_back().position = Vec3(1.0f, 2.0f, 3.0f);
    const uint64_t before = hashStates(target.states);
    SerializeCallbacks calls = files::readCalls(target);
    std::string place;
    bool asked_for_too_much = false;
    const auto resize = calls.resize;
    calls.resize = [&](const SceneCounts& in_file, SceneArrays& arrays) {
      asked_for_too_much = !isWithin(in_file);
      return !asked_for_too_much && resize(in_file, arrays);
    };
    calls.error = [&](const SerializeFailure& f) { place = describe(f); };
    const files::TextFile file(fuzz::damaged(good, n));
    const SerializeError error = serializeRead(file.get(), calls);
    EXPECT_FALSE(asked_for_too_much) << n;
    if (error == SerializeError::Ok) {
      EXPECT_EQ(files::written(target), good) << n;
      continue;
    }
    ++refused;
    EXPECT_TRUE(error == SerializeError::File || place.starts_with("line ")) << n << ": " << place;
    EXPECT_EQ(hashStates(target.states), before) << n;
    EXPECT_EQ(target.states.size(), 1u) << n;
  }
  EXPECT_GE(refused, fuzz::kDamagedFiles - 10) << "hardly a file is damaged in nothing but blanks";
}

INSTANTIATE_TEST_SUITE_P(Scenes, DamagedArrays,
                         testing::Values("1_simple/primitives", "6_joint/basic_joints"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::ranges::replace(name, '/', '_');
                           return name;
                         });

}  // namespace
