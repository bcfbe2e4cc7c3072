// A body that gets other shapes, and casts that pass some bodies.
#include <gtest/gtest.h>

#include "pfx/high_level/world/world.h"

namespace pfx {
namespace {

constexpr float kDt = 1.0f / 60.0f;

struct BoxOnGround {
  World world;
  BodyId ground = world.addBody({.pose = {.position = Vec3(0.0f, -1.0f, 0.0f)},
                                 .motion_type = MotionType::Fixed,
                                 .shapes = {Shape{Box{Vec3(10.0f, 1.0f, 10.0f)}, {}}}});
  BodyId box = world.addBody({.name = "box",
                              .pose = {.position = Vec3(0.0f, 0.5f, 0.0f)},
                              .shapes = {Shape{Box{Vec3::Constant(0.5f)}, {}}}});
  explicit BoxOnGround(const WorldDef& def = {}) : world(def) {}
  float run(int steps) {
    for (int i = 0; i < steps; ++i) world.step(kDt);
    return world.states()[box.index].position.y();
  }
};

TEST(WorldShapes, aBodyRestsOnTheShapesThatItHasNow) {
  for (const bool sleeping : {false, true}) {
    BoxOnGround w({.sleeping = sleeping, .sleep_steps = 30});
    EXPECT_NEAR(w.run(120), 0.5f, 1e-3f);
    EXPECT_EQ(w.world.states()[w.box.index].asleep, sleeping);
    const Shape low{Box{Vec3(0.5f, 0.2f, 0.5f)}, {}};
    w.world.setShapes(w.box, {&low, 1});
    EXPECT_NEAR(w.run(120), 0.2f, 1e-3f) << "smaller: it falls";
    const Shape legs[] = {{Sphere{0.3f}, {.position = Vec3(-0.5f, 0.0f, 0.0f)}},
                          {Sphere{0.3f}, {.position = Vec3(0.5f, 0.0f, 0.0f)}}};
    w.world.setShapes(w.box, legs);
    EXPECT_NEAR(w.run(300), 0.3f, 2e-3f) << "larger: it is lifted out";
    EXPECT_EQ(w.world.collidables()[w.box.index].shapes().size(), 2u);
  }
}

TEST(WorldShapes, badOnesAreRefusedAndChangeNothing) {
  BoxOnGround w;
  const Shape bad{Sphere{-1.0f}, {}};
  EXPECT_THROW(w.world.setShapes(w.box, {&bad, 1}), std::invalid_argument);
  EXPECT_THROW(w.world.setShapes(w.box, {}), std::invalid_argument);
  EXPECT_THROW(w.world.setShapes({}, {&bad, 1}), std::invalid_argument);
  EXPECT_NEAR(w.run(60), 0.5f, 1e-3f);
}

TEST(WorldShapes, aCastPassesTheBodyAndTheTypesThatItIsToldTo) {
  BoxOnGround w;
  const Geometry ball = Sphere{0.1f};
  const auto cast = [&](uint32_t ignored, uint8_t types) {
    return w.world
        .castShape({.geometry = ball,
                    .start = {.position = Vec3(0.0f, 3.0f, 0.0f)},
                    .motion = Vec3(0.0f, -5.0f, 0.0f),
                    .ignore_body = ignored,
                    .motion_types = types})
        .body;
  };
  EXPECT_EQ(cast(kNoBody, 0xffu), w.box.index);
  EXPECT_EQ(cast(w.box.index, 0xffu), w.ground.index);
  EXPECT_EQ(cast(kNoBody, motionTypeBit(MotionType::Fixed)), w.ground.index);
  EXPECT_EQ(cast(w.ground.index, motionTypeBit(MotionType::Fixed)), kNoBody);
}

}  // namespace
}  // namespace pfx
