// The golden flow with synthetic pictures: what passes, what fails and why, approval, shards, JUnit and the
// report.
#include "viewer/golden/verify.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "pictures.h"
#include "viewer/file.h"
#include "viewer/golden/approve.h"
#include "viewer/golden/junit.h"
#include "viewer/golden/report.h"
#include "viewer/image/png.h"
#include "viewer/input_error.h"

namespace golden_tests {
using namespace viewer;
namespace fs = std::filesystem;

// What the synthetic source shows; one switch for each thing that can change.
struct Show {
  Change change = Change::None;
  uint64_t state_hash = 0x1234;
  std::string renderer = "painter 1";
  bool broken = false;
};

class Painter : public FrameSource {
 public:
  explicit Painter(const Show& show) : show_(show) {}
  std::string fingerprint() const override { return show_.renderer; }
  void render(const SceneSpec& scene, std::span<const int> frames,
              const std::function<void(RenderedFrame&&)>& use) override {
    if (show_.broken && scene.name == "tower") throw std::runtime_error("the tower fell");
    for (int frame : frames) use({frame, show_.state_hash + uint64_t(frame), drawPicture(show_.change)});
  }

 private:
  Show show_;
};

SceneSpec scene(const std::string& sample, const std::string& name) {
  SceneSpec s;
  s.sample = sample, s.name = name, s.frames = {0, 60};
  return s;
}

class Golden : public testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::path(testing::TempDir()) /
           (std::string("vitrine_golden_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(dir_);
    fs::create_directories(dir_ / "golden");
    settings_.golden_dir = dir_ / "golden";
    settings_.find_stale = true;
  }
  void TearDown() override { fs::remove_all(dir_); }

  std::vector<FrameResult> run(const Show& show) {
    return verifyScenes(scenes_, settings_, [&] { return std::make_unique<Painter>(show); }, {});
  }
  // Accepts what Show{} draws.
  void acceptAll() { approve(run({}), settings_.golden_dir, "first pictures"); }

  void expectAll(const std::vector<FrameResult>& results, bool pass, Triage triage) {
    ASSERT_EQ(results.size(), 4u);
    for (const FrameResult& r : results) {
      EXPECT_EQ(r.pass, pass) << r.name() << ": " << r.why;
      EXPECT_EQ(r.triage, triage) << r.name() << ": " << r.why;
      EXPECT_FALSE(r.why.empty());
    }
  }

  fs::path dir_;
  VerifySettings settings_;
  std::vector<SceneSpec> scenes_ = {scene("2_stable", "tower"), scene("1_simple", "primitives")};
};

TEST_F(Golden, FramesWithoutAGoldenImageFailUntilApproved) {
  expectAll(run({}), false, Triage::NewFrame);
  acceptAll();
  expectAll(run({}), true, Triage::None);
  EXPECT_TRUE(fs::exists(dir_ / "golden" / "2_stable" / "tower_60.png"));
  EXPECT_TRUE(fs::exists(dir_ / "golden" / "2_stable" / "tower_60.json"));
}

TEST_F(Golden, TellsPhysicsChangesFromRendererChanges) {
  acceptAll();
  expectAll(run({.change = Change::BoxMissing, .state_hash = 99}), false, Triage::PhysicsChange);
  expectAll(run({.change = Change::BoxMissing}), false, Triage::RendererChange);
  expectAll(run({.state_hash = 99}), false, Triage::HiddenPhysics);
  scenes_[0].camera.yaw_deg += 1.0f, scenes_[1].camera.distance += 1.0f;
  expectAll(run({.change = Change::BoxMissing}), false, Triage::CameraChange);
}

TEST_F(Golden, AnotherRasteriserIsJudgedByTheLooserRuleUnlessStrict) {
  acceptAll();
  const Show moved{.change = Change::BoxMovedOneCentimetre, .renderer = "painter 2"};
  const auto loose = run(moved);
  expectAll(loose, true, Triage::None);
  for (const FrameResult& r : loose) EXPECT_FALSE(r.same_rasteriser);
  expectAll(run({.change = Change::BoxMissing, .renderer = "painter 2"}), false, Triage::RendererChange);
  settings_.strict_renderer = true;
  expectAll(run({.renderer = "painter 2"}), false, Triage::RendererChange);
  expectAll(run({}), true, Triage::None);
}

TEST_F(Golden, ResultsDoNotDependOnTheNumberOfWorkers) {
  acceptAll();
  const Show show{.change = Change::DigitChanged};
  const auto one = run(show);
  settings_.workers = 3;
  const auto three = run(show);
  ASSERT_EQ(one.size(), three.size());
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].name(), three[i].name());
    EXPECT_EQ(one[i].actual_png, three[i].actual_png);
    EXPECT_EQ(one[i].verdict.difference.pixels_over, three[i].verdict.difference.pixels_over);
  }
}

TEST_F(Golden, ASceneThatFailsIsReportedAndTheOthersGoOn) {
  acceptAll();
  const auto results = run({.broken = true});
  ASSERT_EQ(results.size(), 4u);
  EXPECT_EQ(results[0].triage, Triage::SceneError);
  EXPECT_EQ(results[1].why, "the tower fell");
  EXPECT_TRUE(results[2].pass);
  const Approval approval = approve(results, settings_.golden_dir, "must not accept a failed scene");
  EXPECT_TRUE(approval.written.empty());
}

TEST_F(Golden, DamagedFilesAreNamed) {
  acceptAll();
  const fs::path picture = dir_ / "golden" / "2_stable" / "tower_0.png";
  const fs::path record = dir_ / "golden" / "2_stable" / "tower_60.json";
  std::vector<uint8_t> bytes = readFile(picture);
  bytes.resize(bytes.size() / 2);
  writeFile(picture, bytes);
  writeText(record, "{\"target\": \"2_stable/tower\"}");
  // A picture that was swapped for another one: its record no longer describes it.
  writePng(dir_ / "golden" / "1_simple" / "primitives_0.png", drawPicture(Change::LineMissing));
  fs::remove(dir_ / "golden" / "1_simple" / "primitives_60.json");
  const auto results = run({});
  expectAll(results, false, Triage::DamagedGolden);
  EXPECT_EQ(results[0].why.find(picture.string()), 0u) << results[0].why;
  EXPECT_EQ(results[1].why.find(record.string()), 0u) << results[1].why;
  EXPECT_NE(results[2].why.find("not the picture that its record describes"), std::string::npos);
  approve(results, settings_.golden_dir, "repaired");
  expectAll(run({}), true, Triage::None);
}

TEST_F(Golden, ApprovalNeedsAReasonAndLogsOneLine) {
  EXPECT_THROW(approve(run({}), settings_.golden_dir, " \n"), InputError);
  EXPECT_FALSE(fs::exists(dir_ / "golden" / "2_stable"));
  acceptAll();
  approve(run({}), settings_.golden_dir, "nothing changed, nothing to log");
  approve(run({.change = Change::ColourFivePercent}), settings_.golden_dir, "new\npaint");
  const std::string log = readText(dir_ / "golden" / "APPROVALS.md");
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 6) << log;  // head of four lines, two approvals
  EXPECT_NE(log.find("first pictures - accepted 2_stable/tower_0, 2_stable/tower_60"), std::string::npos)
      << log;
  EXPECT_NE(log.find("new paint - accepted"), std::string::npos) << log;
}

TEST_F(Golden, StaleImagesFailAndApprovalRemovesThem) {
  acceptAll();
  const std::vector<SceneSpec> both = scenes_;
  scenes_.pop_back();
  auto results = run({});
  ASSERT_EQ(results.size(), 4u);
  EXPECT_EQ(results[2].triage, Triage::StaleGolden);
  EXPECT_EQ(results[2].name(), "1_simple/primitives_0");
  EXPECT_EQ(approve(results, settings_.golden_dir, "scene removed").removed.size(), 2u);
  EXPECT_EQ(run({}).size(), 2u);
}

TEST_F(Golden, AnImageMayHaveItsOwnTolerance) {
  acceptAll();
  const fs::path file = dir_ / "golden" / "2_stable" / "tower_0.json";
  GoldenRecord record = readRecord(file);
  record.tolerance =
      Tolerance{{.max_channel = 255, .pixels_over = 1.0, .max_block = 255.0f}, "shows a clock"};
  writeRecord(file, record);
  const auto results = run({.change = Change::DigitChanged});
  EXPECT_TRUE(results[0].pass);
  EXPECT_FALSE(results[1].pass);
  approve(results, settings_.golden_dir, "other digits");
  EXPECT_EQ(readRecord(file).tolerance->reason, "shows a clock");

  std::string text = readText(file);
  text.replace(text.find("shows a clock"), 13, "");
  writeText(file, text);
  EXPECT_THROW(readRecord(file), InputError);
}

TEST(Shard, TogetherTheyAreTheWholeSuite) {
  std::vector<SceneSpec> scenes;
  for (int i = 0; i < 7; ++i) scenes.push_back(scene("s", std::to_string(i)));
  std::vector<std::string> names;
  for (int index = 1; index <= 3; ++index)
    for (const SceneSpec& s : shard(scenes, index, 3)) names.push_back(s.name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"0", "1", "2", "3", "4", "5", "6"}));
}

TEST_F(Golden, JUnitCountsFailuresAndEscapesText) {
  acceptAll();
  auto results = run({});
  results[1].pass = false, results[1].why = "<\"&";
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(junitXml(results, 1.5).c_str()));
  const pugi::xml_node suite = document.child("testsuites").child("testsuite");
  EXPECT_EQ(suite.attribute("tests").as_int(), 4);
  EXPECT_EQ(suite.attribute("failures").as_int(), 1);
  const pugi::xml_node second = suite.child("testcase").next_sibling();
  EXPECT_STREQ(second.attribute("classname").value(), "2_stable/tower");
  EXPECT_STREQ(second.child("failure").attribute("message").value(), "<\"&");
}

TEST_F(Golden, TheReportHoldsEveryPictureThatItShows) {
  acceptAll();
  auto results = run({.change = Change::LineMissing});
  const fs::path index =
      writeReport(dir_ / "report", results, {.renderer = "painter </script>", .seconds = 1.0});
  const std::string page = readText(index);
  const size_t begin = page.find("id=\"data\">") + 10;
  const std::string json = page.substr(begin, page.find("</script>", begin) - begin);
  const auto data = nlohmann::json::parse(json);
  EXPECT_EQ(data["renderer"], "painter </script>");
  ASSERT_EQ(data["frames"].size(), 4u);
  for (const auto& frame : data["frames"])
    for (const char* kind : {"expected", "actual", "difference", "heat"})
      EXPECT_EQ(readPng(dir_ / "report" / frame[kind].get<std::string>()).width, 640);
}

TEST_F(Golden, TheReportBeginsWithTheWorst) {
  acceptAll();
  auto results = run({.change = Change::DigitChanged});
  results[0].pass = true;
  results[1].verdict.flip->max_block = 0.1f, results[2].verdict.flip->max_block = 0.9f;
  results[3].actual_png.clear();
  EXPECT_EQ(worstFirst(results), (std::vector<size_t>{3, 2, 1, 0}));
}

}  // namespace golden_tests
