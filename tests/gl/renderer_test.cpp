// The renderer: equal bits from every context, no state between renderers and frames, and the properties that
// a picture must have whatever it looks like.
#include "viewer/render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "viewer/draw_list/recorder.h"

namespace viewer {
namespace {

using pfx::Finish;
using pfx::Quat;
using pfx::Vec3;

constexpr FrameInput kSmall = {.width = 160, .height = 90};

Instance solid(const Vec3& at, const Vec3& scale, uint32_t body, Finish finish = Finish::Soft) {
  return {at, Quat::Identity(), scale, 0xffc07840u, uint32_t(finish), pickId(PickKind::Body, body)};
}

// A floor, a box, a sphere, a cylinder, one shiny and one translucent body, and every kind of overlay.
void recordScene(DrawList& list) {
  list.begin();
  list.camera = orbitCamera({.target = Vec3(0, 0.7f, 0), .distance = 9, .yaw_deg = 30, .pitch_deg = 25});
  list.add(kUnitBox, solid(Vec3(0, -0.5f, 0), Vec3(40, 0.5f, 40), 0, Finish::Matte));
  list.add(kUnitBox, solid(Vec3(-2, 1, 0), Vec3::Ones(), 1));
  list.add(kRound, solid(Vec3(0.5f, 0.7f, 0), Vec3(0, 0.7f, 0.7f), 2, Finish::Glossy));
  list.add(kUnitCylinder, solid(Vec3(2.5f, 0.5f, 0), Vec3(0.8f, 0.5f, 0.5f), 3, Finish::Metallic));
  list.add(kUnitBox, solid(Vec3(0, 0.5f, 2), Vec3(0.5f, 0.5f, 0.5f), 4, Finish::Translucent));
  list.add(Line{Vec3(-3, 2.5f, 0), Vec3(3, 2.5f, 0), 0xff204080u});
  list.add(Arrow{Vec3(0, 1, 1), Vec3(0, 2, 1), 0xff802020u});
  list.add(Point{Vec3(-2, 2, 0), 0xff208040u, 8.0f});
  list.add(Label{Vec3(-2, 2, 0), "box"});
  list.end();
}

DrawList scene() {
  DrawList list;
  recordScene(list);
  return list;
}

Image picture(Backend backend, const DrawList& list, const FrameInput& frame = kSmall) {
  const auto context = makeContext({.backend = backend});
  Renderer renderer(*context);
  renderer.draw(frame, list);
  return renderer.readBack();
}

size_t differences(const Image& a, const Image& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.rgba.size(); i += 4) count += !std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]);
  return count;
}

TEST(Renderer, OsMesaAndEglDrawTheSameBits) {
  const DrawList list = scene();
  EXPECT_EQ(picture(Backend::OsMesa, list).rgba, picture(Backend::Egl, list).rgba);
}

TEST(Renderer, AWindowDrawsTheSameBits) {
  if (!std::getenv("DISPLAY")) {
    EXPECT_THROW(makeContext({.backend = Backend::Glfw}), ContextError);
    return;
  }
  const DrawList list = scene();
  EXPECT_EQ(picture(Backend::OsMesa, list).rgba, picture(Backend::Glfw, list).rgba);
}

TEST(Renderer, APictureDoesNotDependOnWhatWasDrawnBefore) {
  const auto context = makeContext({});
  Renderer renderer(*context);
  DrawList list;
  list.begin();
  for (int i = 0; i < 300; ++i)
    list.add(kUnitBox, solid(Vec3(float(i % 20), float(i / 20), 0), Vec3::Constant(0.4f), 1));
  list.add(Line{Vec3::Zero(), Vec3::Ones(), 0xff000000u});
  list.end();
  renderer.draw({.width = 200, .height = 100, .selected = pickId(PickKind::Body, 1)}, list);
  recordScene(list);
  renderer.draw(kSmall, list);
  EXPECT_EQ(renderer.readBack().rgba, picture(Backend::Auto, scene()).rgba);
}

TEST(Renderer, TwoRenderersOnTwoContextsDoNotDisturbEachOther) {
  const DrawList list = scene();
  const Image alone = picture(Backend::OsMesa, list);
  const auto first_context = makeContext({.backend = Backend::OsMesa});
  const auto second_context = makeContext({.backend = Backend::Egl});
  Renderer first(*first_context), second(*second_context);
  DrawList other;
  recordScene(other);
  other.camera = orbitCamera({.distance = 4});
  first.draw(kSmall, list);
  second.draw({.width = 64, .height = 64}, other);
  EXPECT_EQ(first.readBack().rgba, alone.rgba);
  first.draw(kSmall, list);
  EXPECT_EQ(first.readBack().rgba, alone.rgba);
}

TEST(Renderer, OneRendererShowsTwoListsInTurnWithoutMixingThem) {
  const auto context = makeContext({});
  Renderer renderer(*context);
  DrawList a = scene(), b = scene();
  b.begin();
  b.camera = a.camera;
  b.add(kUnitBox, solid(Vec3(1, 1, 1), Vec3::Ones(), 9));
  b.end();
  renderer.draw(kSmall, a);
  const Image first = renderer.readBack();
  renderer.draw(kSmall, b);
  renderer.draw(kSmall, a);
  EXPECT_EQ(renderer.readBack().rgba, first.rgba);
}

TEST(Renderer, AnUnchangedListSendsNoInstancesAgain) {
  const auto context = makeContext({});
  Renderer renderer(*context);
  DrawList list;
  const auto record = [&](float y) {
    list.begin();
    for (int i = 0; i < 1000; ++i)
      list.add(kUnitBox,
               solid(Vec3(float(i % 30), i == 500 ? y : 0.0f, float(i / 30)), Vec3::Constant(0.4f), 1));
    list.end();
  };
  record(0.0f);
  EXPECT_GE(renderer.draw(kSmall, list).uploaded_bytes, 1000 * sizeof(Instance));
  record(0.0f);
  EXPECT_EQ(renderer.draw(kSmall, list).uploaded_bytes, 0u);
  record(1.0f);
  EXPECT_EQ(renderer.draw(kSmall, list).uploaded_bytes, Batch::kBlock * sizeof(Instance));
}

TEST(Renderer, AnEmptySceneIsASkyThatGetsLighterTowardsTheHorizon) {
  DrawList list;
  list.begin();
  list.camera = orbitCamera({.distance = 10, .yaw_deg = 0, .pitch_deg = -8});
  list.end();
  const Image image = picture(Backend::Auto, list);
  const auto blue_minus_red = [&](int y) {
    const uint8_t* p = &image.rgba[size_t(y * image.width + image.width / 2) * 4];
    return int(p[2]) - int(p[0]);
  };
  // Of 90 rows over 40 degrees the horizon is row 62.
  EXPECT_GT(blue_minus_red(2), blue_minus_red(60) + 20);
}

TEST(Renderer, TheSunThrowsAShadowOntoTheFloor) {
  DrawList with = scene();
  DrawList without = with;
  without.sun.shadows = false;
  const Image a = picture(Backend::Auto, with), b = picture(Backend::Auto, without);
  size_t darker = 0;
  for (size_t i = 0; i < a.rgba.size(); i += 4) darker += int(a.rgba[i]) + 20 < int(b.rgba[i]);
  EXPECT_GT(darker, 200u);
  // Light comes from nowhere: no pixel gets brighter by a shadow (one level of rounding).
  for (size_t i = 0; i < a.rgba.size(); ++i) ASSERT_LE(int(a.rgba[i]), int(b.rgba[i]) + 1);
}

TEST(Renderer, EveryVisibleBodyIsInTheIdsAndHiddenOnesAreNot) {
  const auto context = makeContext({});
  Renderer renderer(*context);
  DrawList list = scene();
  const std::vector<uint32_t> ids = renderer.readIds(kSmall, list);
  const std::set<uint32_t> seen(ids.begin(), ids.end());
  for (uint32_t body = 0; body <= 4; ++body) EXPECT_TRUE(seen.contains(pickId(PickKind::Body, body))) << body;

  list.begin();
  list.camera = orbitCamera({.distance = 10, .yaw_deg = 0, .pitch_deg = 0});
  list.add(kUnitBox, solid(Vec3(0, 0, 2), Vec3::Ones(), 1));
  list.add(kRound, solid(Vec3(0, 0, -2), Vec3(0, 0.5f, 0.5f), 2));
  list.end();
  const std::vector<uint32_t> hidden = renderer.readIds(kSmall, list);
  EXPECT_EQ(std::count(hidden.begin(), hidden.end(), pickId(PickKind::Body, 2)), 0);
  EXPECT_GT(std::count(hidden.begin(), hidden.end(), pickId(PickKind::Body, 1)), 100);
}

TEST(Renderer, PickingFindsTheBodyAndThePointOnItsSurface) {
  const auto context = makeContext({});
  Renderer renderer(*context);
  DrawList list;
  list.begin();
  list.camera = orbitCamera({.distance = 10, .yaw_deg = 0, .pitch_deg = 0});
  list.add(kRound, solid(Vec3::Zero(), Vec3(0, 1, 1), 7));
  list.end();
  const FrameInput frame = {.width = 201, .height = 201};
  const PickHit hit = renderer.pick(frame, list, 100, 100);
  EXPECT_EQ(hit.id, pickId(PickKind::Body, 7));
  EXPECT_LT((hit.position - Vec3(0, 0, 1)).norm(), 1e-3f);  // 32-bit depth over 0.1 to 400 m
  EXPECT_EQ(renderer.pick(frame, list, 2, 2).id, 0u);
  EXPECT_EQ(renderer.pick(frame, list, -5, 900).id, 0u);
}

TEST(Renderer, ASphereCoversTheDiscThatGeometrySays) {
  const auto context = makeContext({});
  Renderer renderer(*context);
  DrawList list;
  list.begin();
  list.camera = orbitCamera({.distance = 10, .yaw_deg = 0, .pitch_deg = 0});
  list.camera.orthographic = true;
  list.camera.ortho_height_m = 4.0f;
  list.add(kRound, solid(Vec3::Zero(), Vec3(0, 1, 1), 7));
  list.end();
  const std::vector<uint32_t> ids = renderer.readIds({.width = 400, .height = 400}, list);
  // Radius 1 m at 100 px/m. The count of pixel centres in a circle differs from its area by less than its
  // border.
  EXPECT_NEAR(double(std::count(ids.begin(), ids.end(), pickId(PickKind::Body, 7))), 3.14159265 * 100 * 100,
              100.0);
}

TEST(Renderer, TheSelectionGetsAnOutlineAndNothingElseChanges) {
  const auto context = makeContext({});
  Renderer renderer(*context);
  const DrawList list = scene();
  renderer.draw(kSmall, list);
  const Image plain = renderer.readBack();
  renderer.draw({.width = 160, .height = 90, .selected = pickId(PickKind::Body, 1)}, list);
  const Image outlined = renderer.readBack();
  const size_t changed = differences(plain, outlined);
  EXPECT_GT(changed, 50u);
  EXPECT_LT(changed, 600u);
  renderer.draw({.width = 160, .height = 90, .selected = pickId(PickKind::Body, 999)}, list);
  EXPECT_EQ(renderer.readBack().rgba, plain.rgba);
}

TEST(Renderer, BadSizesAndReadingBeforeDrawingAreErrors) {
  const auto context = makeContext({});
  Renderer renderer(*context);
  EXPECT_THROW(renderer.readBack(), RenderError);
  const DrawList list = scene();
  for (const auto& [w, h] : {std::pair(0, 10), {10, -1}, {9000, 10}})
    EXPECT_THROW(renderer.draw({.width = w, .height = h}, list), RenderError);
}

TEST(Renderer, OddSizesAndOnePixelWork) {
  const DrawList list = scene();
  for (const auto& [w, h] : {std::pair(1, 1), {333, 77}}) {
    const Image image = picture(Backend::Auto, list, {.width = w, .height = h});
    EXPECT_EQ(image.rgba.size(), size_t(w) * size_t(h) * 4);
  }
}

TEST(Renderer, EveryQualityDraws) {
  const DrawList list = scene();
  const auto context = makeContext({});
  for (const Quality quality : {Quality::Ci, Quality::Window, Quality::Hero}) {
    Renderer renderer(*context, {.quality = quality});
    renderer.draw(kSmall, list);
    EXPECT_FALSE(renderer.readBack().empty());
  }
}

TEST(Renderer, ABrokenShaderIsNamed) {
  const auto context = makeContext({});
  try {
    Renderer renderer(*context, {.shader_dir = "/nowhere"});
    FAIL() << "the shaders were found";
  } catch (const RenderError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/"), std::string::npos);
  }
}

TEST(GlContext, BackendNamesAreReadAndUnknownOnesRefused) {
  EXPECT_EQ(parseBackend("osmesa"), Backend::OsMesa);
  EXPECT_EQ(parseBackend("auto"), Backend::Auto);
  EXPECT_EQ(parseBackend("OSMesa"), std::nullopt);
  EXPECT_EQ(parseBackend(""), std::nullopt);
}

TEST(GlContext, AMissingDisplayIsToldWithItsReason) {
  const char* display = std::getenv("DISPLAY");
  const std::string kept = display ? display : "";
  setenv("DISPLAY", ":987", 1);
  try {
    makeContext({.backend = Backend::Glfw});
    // A process that opened a display before keeps it.
    SUCCEED();
  } catch (const ContextError& error) {
    EXPECT_NE(std::string(error.what()).find("glfw"), std::string::npos);
  }
  display ? setenv("DISPLAY", kept.c_str(), 1) : unsetenv("DISPLAY");
}

TEST(GlContext, VariablesThatChangeTheRasterizerAreRemoved) {
  setenv("LP_NATIVE_VECTOR_WIDTH", "512", 1);  // crashes this rasterizer
  setenv("GALLIUM_DRIVER", "softpipe", 1);
  setenv("LP_NUM_THREADS", "1", 1);
  const auto context = makeContext({});
  EXPECT_EQ(std::getenv("LP_NATIVE_VECTOR_WIDTH"), nullptr);
  EXPECT_EQ(std::getenv("GALLIUM_DRIVER"), nullptr);
  EXPECT_STREQ(std::getenv("LP_NUM_THREADS"), "1");
  unsetenv("LP_NUM_THREADS");
}

}  // namespace
}  // namespace viewer
