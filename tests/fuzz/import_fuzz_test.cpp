// Damaged URDF and OBJ files: refused by name, or read as a model that can be run; never a crash.
#include <gtest/gtest.h>

#include <cstdio>
#include <regex>

#include "pfx/high_level/scene_file/obj_reader.h"
#include "pfx/high_level/scene_file/urdf_reader.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/fuzz/damage.h"

namespace {

using namespace pfx;

TEST(DamagedUrdf, IsRefusedByNameOrGivesAModelThatRuns) {
  if (!canReadUrdf()) GTEST_SKIP() << "built without liburdfdom";
  const std::string good = readTextFile(std::filesystem::path(VITRINE_SOURCE_DIR) / "samples/11_xml_import/arm.urdf");
  const size_t last_letter = good.find_last_not_of(" \n");
  int refused = 0;
  for (int n = 0; n < fuzz::kDamagedFiles; ++n) {
    const std::string bad = fuzz::damaged(good, n);
    World world;
    try {
      buildScene(readUrdf(SceneText{.xml = bad, .name = "damaged.urdf"}), world);
    } catch (const SceneError& e) {
      ++refused;
      EXPECT_TRUE(std::string_view(e.what()).starts_with("damaged.urdf:")) << n << ": " << e.what();
      continue;
    }
    EXPECT_GT(bad.size(), last_letter) << n << ": a file that was cut off must be refused";
    EXPECT_LE(world.counts().bodies, 5u) << n;
    world.step(1.0f / 60.0f);
  }
  std::printf("arm.urdf: %d of %d damaged files refused\n", refused, fuzz::kDamagedFiles);
  EXPECT_GE(refused, fuzz::kDamagedFiles / 2);
}

// A dome of 12 x 12 quads, with everything that the reader knows and a few things that it skips.
std::string domeText() {
  std::string text = "# dome\no dome\n";
  char line[64];
  for (int i = 0; i <= 12; ++i)
    for (int k = 0; k <= 12; ++k) {
      std::snprintf(line, sizeof line, "v %d %.3f %d\n", i, 0.05 * (36 - (i - 6) * (i - 6)), k);
      text += line;
    }
  text += "vn 0 1 0\nvt 0.5 0.5\ns off\n";
  for (int i = 0; i < 12; ++i)
    for (int k = 0; k < 12; ++k) {
      const int a = 13 * i + k + 1;
      std::snprintf(line, sizeof line, "f %d/1/1 %d//1 %d -%d\n", a, a + 1, a + 14, 170 - (a + 13));
      text += line;
    }
  return text;
}

TEST(DamagedObj, IsRefusedWithItsLineOrGivesNoMoreThanItHad) {
  const std::string good = domeText();
  const TriangleList whole = readObj(good, "good.obj");
  ASSERT_EQ(whole.indices.size(), 12u * 12u * 6u);
  const std::regex place("^damaged.obj:[0-9]+: .+");
  int refused = 0;
  for (int n = 0; n < fuzz::kDamagedFiles; ++n) {
    TriangleList list;
    try {
      list = readObj(fuzz::damaged(good, n), "damaged.obj");
    } catch (const SceneError& e) {
      ++refused;
      EXPECT_TRUE(std::regex_match(e.what(), place)) << n << ": " << e.what();
      continue;
    }
    // A line that ends in a place where it did not before is one vertex or face more.
    EXPECT_LE(list.vertices.size(), whole.vertices.size() + 4) << n;
    EXPECT_LE(list.indices.size(), whole.indices.size() + 4 * 6) << n;
    for (const uint32_t i : list.indices) ASSERT_LT(i, list.vertices.size()) << n;
    buildLargeMesh(list.vertices, list.indices);  // any error code, no crash
  }
  std::printf("dome.obj: %d of %d damaged files refused\n", refused, fuzz::kDamagedFiles);
  EXPECT_GE(refused, fuzz::kDamagedFiles / 10);
}

}  // namespace
