// The comparator's self-test on real renders: seeded defects must fail, harmless variation must pass.
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "pictures.h"
#include "program.h"
#include "viewer/context/gl_context.h"
#include "viewer/image/png.h"
#include "viewer/image/verdict.h"
#include "viewer/render/renderer.h"

namespace golden_tests {
using namespace viewer;

// A pyramid of boxes of 1 m, seen from 16 m away, with lines beside it and a figure on the screen.
void fillList(DrawList& list, Change change) {
  list.camera.eye = pfx::Vec3(5.0f, 6.0f, 16.0f);
  list.camera.target = pfx::Vec3(0.0f, 3.0f, 0.0f);
  for (int row = 0; row < 7; ++row)
    for (int column = 0; column < 7 - row; ++column) {
      const bool chosen = row == 3 && column == 1;
      if (chosen && change == Change::BoxMissing) continue;
      Instance box;
      box.position = pfx::Vec3(1.1f * (float(column) - 0.5f * float(6 - row)), 0.5f + float(row), 0.0f);
      box.scale = pfx::Vec3::Constant(0.49f);
      box.color = 0xffc08040u + uint32_t(row) * 0x00040800u;
      if (chosen && change == Change::BoxMovedOneCentimetre) box.position.x() += 0.01f;
      if (chosen && change == Change::ColourFivePercent) box.color = (box.color & 0xff00ffffu) | 0x00d40000u;
      list.add(kUnitBox, box);
    }
  for (int i = 0; i < 40; ++i) {
    if (i == 20 && change == Change::LineMissing) continue;
    const float x = -5.0f + 0.25f * float(i);
    list.add(Line{pfx::Vec3(x, 0.0f, 2.0f), pfx::Vec3(x + 0.1f, 0.4f, 2.0f), 0xff2050c0u});
  }
  list.add(Label{pfx::Vec3(16.0f, 16.0f, 0.0f), change == Change::DigitChanged ? "41.83 J" : "41.33 J",
                 0xff20242bu, true});
}

// Draws with one context and one renderer for the whole test program: making them is what costs time.
Image drawList(Backend backend, Change change) {
  struct Studio {
    std::unique_ptr<GlContext> context;
    std::unique_ptr<Renderer> renderer;
  };
  // Never destroyed: at exit the drivers are gone before it would be its turn.
  static auto& studios = *new std::map<Backend, Studio>;
  Studio& studio = studios[backend];
  if (!studio.renderer) {
    studio.context = makeContext({.backend = backend});
    studio.renderer = std::make_unique<Renderer>(*studio.context);
  }
  DrawList list;
  list.begin();
  fillList(list, change);
  list.end();
  studio.renderer->draw({.width = 640, .height = 360}, list);
  return studio.renderer->readBack();
}

class RenderedDefect : public testing::TestWithParam<Change> {};

TEST_P(RenderedDefect, FailsTheVerdict) {
  const Verdict v =
      judge(drawList(Backend::Auto, Change::None), drawList(Backend::Auto, GetParam()), Rasteriser::Same);
  EXPECT_FALSE(v.pass) << v.why;
}

INSTANTIATE_TEST_SUITE_P(All, RenderedDefect,
                         testing::Values(Change::BoxMissing, Change::BoxMovedOneCentimetre,
                                         Change::ColourFivePercent, Change::LineMissing,
                                         Change::DigitChanged),
                         kChangeName);

TEST(RenderedVariation, TheSamePictureTwiceIsExact) {
  EXPECT_EQ(imageHash(drawList(Backend::Auto, Change::None)),
            imageHash(drawList(Backend::Auto, Change::None)));
}

TEST(RenderedVariation, OsMesaAndEglDrawThePictureThatPasses) {
  const Verdict v =
      judge(drawList(Backend::OsMesa, Change::None), drawList(Backend::Egl, Change::None), Rasteriser::Same);
  EXPECT_TRUE(v.pass) << v.why;
}

TEST(RenderedVariation, TheNumberOfRasteriserThreadsDoesNotShow) {
  const ScratchFolder scratch("threads");
  for (const char* threads : {"0", "2"})
    ASSERT_EQ(runShell(std::string("LP_NUM_THREADS=") + threads + " '" + VITRINE_PROGRAM +
                       "' render 2_stable/tower --frames 0 --out '" + (scratch / threads) + "'")
                  .status,
              0);
  const Verdict v = judge(readPng(scratch / "0/2_stable/tower_0.png"),
                          readPng(scratch / "2/2_stable/tower_0.png"), Rasteriser::Same);
  EXPECT_TRUE(v.pass) << v.why;
}

}  // namespace golden_tests
