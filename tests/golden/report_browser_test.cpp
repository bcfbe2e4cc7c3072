// The HTML report in a real browser without a window: every picture is loaded, the worst frame comes first,
// and each way of looking works. Needs the package chromium.
#include <gtest/gtest.h>
#include <unistd.h>

#include "pictures.h"
#include "program.h"
#include "viewer/golden/approve.h"
#include "viewer/golden/report.h"

namespace golden_tests {
using namespace viewer;

class SyntheticSource : public FrameSource {
 public:
  explicit SyntheticSource(bool changed) : changed_(changed) {}
  std::string fingerprint() const override { return "synthetic <b>&amp;</b> </script>"; }
  void render(const SceneSpec&, std::span<const int> frames,
              const std::function<void(RenderedFrame&&)>& use) override {
    constexpr Change kChanges[] = {Change::None, Change::RoundingNoise, Change::DigitChanged,
                                   Change::BoxMissing};
    for (int frame : frames) use({frame, 7, drawPicture(changed_ ? kChanges[frame] : Change::None)});
  }

 private:
  bool changed_;
};

class Report : public testing::Test {
 protected:
  Report() : scratch_("report") {
    std::filesystem::create_directories(scratch_ / "golden");
    SceneSpec scene;
    scene.sample = "2_stable", scene.name = "tower", scene.frames = {0, 1, 2, 3};
    const VerifySettings settings{.golden_dir = scratch_ / "golden"};
    const auto run = [&](bool changed) {
      return verifyScenes({&scene, 1}, settings, [&] { return std::make_unique<SyntheticSource>(changed); },
                          {});
    };
    approve(run(false), settings.golden_dir, "first pictures");
    page_ = writeReport(scratch_ / "report", run(true), {.renderer = "synthetic", .seconds = 1.0}).string();
  }

  // The page after its scripts ran.
  std::string dom(const std::string& query) const {
    const Outcome o = runShell(
        "timeout 60 chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir='" +
        (scratch_ / "profile") + "' --virtual-time-budget=5000 --dump-dom 'file://" + page_ + query + "'");
    EXPECT_EQ(o.status, 0) << "the report is tested in a browser: install the package chromium\n" << o.err;
    return o.out;
  }
  static size_t count(const std::string& text, const std::string& word) {
    size_t n = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
  }

  ScratchFolder scratch_;
  std::string page_;
};

TEST_F(Report, ShowsEveryFrameWorstFirstWithItsPictures) {
  const std::string page = dom("");
  EXPECT_NE(page.find("data-ready=\"true\""), std::string::npos);
  EXPECT_NE(page.find("data-failed=\"2\""), std::string::npos);
  const size_t box = page.find("<article class=\"fail\" data-name=\"2_stable/tower_3\"");
  const size_t digit = page.find("<article class=\"fail\" data-name=\"2_stable/tower_2\"");
  const size_t noise = page.find("<article class=\"near\" data-name=\"2_stable/tower_1\"");
  ASSERT_NE(box, std::string::npos);
  ASSERT_NE(digit, std::string::npos);
  ASSERT_NE(noise, std::string::npos);
  EXPECT_LT(box, digit);
  EXPECT_LT(digit, noise);
  EXPECT_NE(page.find("<figure data-name=\"2_stable/tower_0\""), std::string::npos)
      << "unchanged frames are shown, too";
  // Three changed frames with expected and actual, and the unchanged one.
  EXPECT_EQ(count(page, "data-loaded=\"640x360\""), 7u);
  EXPECT_EQ(count(page, "type=\"range\""), 3u);
}

TEST_F(Report, TheSliderCutsWhereItStands) {
  const std::string page = dom("?frame=2_stable/tower_3&slider=25");
  EXPECT_EQ(count(page, "<article"), 1u);
  EXPECT_NE(page.find("clip-path: inset(0px 0px 0px 25%)"), std::string::npos) << page;
}

TEST_F(Report, HeatMapDifferenceAndSideBySideCanBeOpened) {
  for (const auto& [mode, pictures] :
       {std::pair<std::string, size_t>{"heat", 1}, {"difference", 1}, {"side", 2}}) {
    const std::string page = dom("?frame=2_stable/tower_3&mode=" + mode);
    EXPECT_NE(page.find("class=\"view\" data-mode=\"" + mode + "\""), std::string::npos) << mode;
    EXPECT_EQ(count(page, "data-loaded=\"640x360\""), pictures) << mode;
  }
}

}  // namespace golden_tests
