// Damaged scene files and snapshots: refused with the place, or (scene files) read with another value where a digit was
// changed; never a crash, and a world that refuses one is as it was.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "pfx/high_level/particles/particle_builder.h"
#include "pfx/high_level/scene_file/scene_file.h"
#include "pfx/high_level/world/snapshot.h"
#include "samples/scene.h"
#include "tests/fuzz/damage.h"

namespace {

using namespace pfx;

// A small one of each kind of particles: cloth on a body, a rope, a soft box.
World particleWorld() {
  World world;
  const BodyId post = world.addBody({.name = "post", .motion_type = MotionType::Fixed, .shapes = {Shape{Box{}, {}}}});
  ParticleDef def{.name = "soft things"};
  addCloth(def, {.corner = Vec3(-0.5f, 2.0f, 0.0f), .columns = 4, .rows = 3, .bending_stiffness = 1e-3f});
  addRope(def, {.from = Vec3(2, 2, 0), .to = Vec3(3, 2, 0), .particles = 5, .bending_stiffness = 1e-3f});
  addSoftBox(def, {.center = Vec3(-3, 2, 0), .half_extent = Vec3::Constant(0.3f), .cells = {1, 2, 1}});
  def.anchors.push_back({.particle = 0, .body = post.index, .local = def.positions[0]});
  def.masses.back() = 0.0f;
  world.addParticles(def);
  return world;
}

World sampleWorld(std::string_view target) {
  if (target == "particles") return particleWorld();
  const samples::SceneEntry& entry = *samples::findScenes(target).front();
  World world(entry.world);
  entry.make()->build(world);
  return world;
}

// A world with something in it that a refused file must leave alone.
struct Witness {
  World world;
  uint64_t before;

  Witness() {
    world.addBody({.name = "witness", .pose = {.position = Vec3(1.0f, 2.0f, 3.0f)}, .shapes = {Shape{Sphere{}, {}}}});
    before = world.stateHash();
  }
  void expectUntouched(int n) const {
    EXPECT_EQ(world.stateHash(), before) << n;
    EXPECT_EQ(world.name(0), "witness") << n;
  }
};

// The elements of a scene, one a line as writeScene() puts them. Rows of numbers in meshes do not begin with '<'; a
// triangle whose corners became the same by a changed digit has no area, and its row is gone.
std::vector<std::string> elementsOf(const std::string& xml) {
  std::vector<std::string> out;
  std::istringstream lines(xml);
  for (std::string line; std::getline(lines, line);) {
    const size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos || line[begin] != '<' || line.compare(begin, 2, "</") == 0) continue;
    out.push_back(line.substr(begin));
  }
  return out;
}

std::string tagOf(const std::string& element) { return element.substr(0, element.find_first_of(" />", 2)); }

// A file that was read although it is damaged says the same as the whole one but for changed values: the same elements
// in the same order, and no more of them differ than bits were turned over.
void expectOnlyValuesChanged(const std::string& damaged, const std::string& whole, int n) {
  constexpr int kMostFlips = 4;
  const auto a = elementsOf(damaged), b = elementsOf(whole);
  ASSERT_EQ(a.size(), b.size()) << n;
  int differ = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(tagOf(a[i]), tagOf(b[i])) << n << ": " << a[i];
    differ += a[i] != b[i];
  }
  EXPECT_LE(differ, kMostFlips) << n;
}

class DamagedFile : public testing::TestWithParam<const char*> {};

TEST_P(DamagedFile, OfASceneIsRefusedWithItsPlaceOrDiffersInNothingButAValue) {
  const std::string good = writeScene(sampleWorld(GetParam()));
  const std::regex place("^damaged.xml:[0-9]+: (<.*>: )?.+");
  const size_t last_letter = good.find_last_not_of(" \n");
  int refused = 0;
  for (int n = 0; n < fuzz::kDamagedFiles; ++n) {
    const std::string bad = fuzz::damaged(good, n);
    Witness w;
    try {
      loadScene(SceneText{.xml = bad, .name = "damaged.xml"}, w.world);
    } catch (const SceneError& e) {
      ++refused;
      EXPECT_TRUE(std::regex_match(e.what(), place)) << n << ": " << e.what();
      w.expectUntouched(n);
      continue;
    }
    EXPECT_GT(bad.size(), last_letter) << n << ": a file that was cut off must be refused";
    expectOnlyValuesChanged(writeScene(w.world), good, n);
    w.world.step(1.0f / 60.0f);
  }
  EXPECT_GE(refused, fuzz::kDamagedFiles / 2);
}

TEST_P(DamagedFile, OfASnapshotIsAlwaysRefusedWithItsSection) {
  World world = sampleWorld(GetParam());
  for (int i = 0; i < 20; ++i) world.step(1.0f / 60.0f);
  std::string good(world.snapshotBytes(), '\0');
  world.snapshot(std::as_writable_bytes(std::span(good)));
  for (int n = 0; n < fuzz::kDamagedFiles; ++n) {
    const std::string bad = fuzz::damaged(good, n);
    Witness w;
    try {
      w.world.restore(std::as_bytes(std::span(bad)));
      ADD_FAILURE() << n << " was taken";
    } catch (const SnapshotError& e) {
      EXPECT_TRUE(std::string(e.what()).starts_with("snapshot: ")) << n << ": " << e.what();
      w.expectUntouched(n);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, DamagedFile,
                         testing::Values("1_simple/primitives", "3_sleep/landscape", "11_xml_import/example", "particles"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           for (char& c : name)
                             if (c == '/') c = '_';
                           return name;
                         });

}  // namespace
