// ACC-33: the same scene at every size. Lengths go by s and gravity stays, so that times go by sqrt(s): in
// units of both, nothing may change. Whatever in the engine is a length, a speed or a time of its own shows
// here.
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

struct Scale {
  float length = 1.0f;  // s
  float time() const { return std::sqrt(length); }
  float speed() const { return std::sqrt(length); }
  float step() const { return kDt * time(); }
};

World makeWorld(const Scale& s) {
  WorldDef def = worldDef(4);
  def.extent *= std::max(1.0f, s.length);
  return World(def);
}

BodyId addSlab(World& world, const Scale& s, float friction, float restitution) {
  return world.addBody({.pose = {.position = s.length * Vec3(0, -1, 0)},
                        .motion_type = MotionType::Fixed,
                        .shapes = {{Box{s.length * Vec3(40, 1, 40)}}},
                        .restitution = restitution,
                        .friction = friction});
}

using Curve = std::vector<double>;

// ACC-05: angle of a rod released from 90 degrees, every sixth step.
Curve pendulum(const Scale& s) {
  World world = makeWorld(s);
  const BodyId post = addPost(world);
  const BodyId rod = addRod(world, {.length = s.length, .width = 0.1f * s.length},
                            downAt(M_PI / 2, 0.5 * double(s.length)), M_PI / 2);
  world.addJoint({.body_a = post,
                  .body_b = rod,
                  .params = HingeJointParams{.anchor_point = Vec3::Zero(), .axis = Vec3::UnitZ()}});
  Curve c;
  for (int i = 1; i <= 240; ++i) {
    world.step(s.step());
    if (i % 6 == 0) c.push_back(angleAboutZ(world.states()[rod.index]));
  }
  return c;
}

// ACC-11: way of a box that slides with friction 0.3, in lengths.
Curve slidingBox(const Scale& s) {
  World world = makeWorld(s);
  addSlab(world, s, 0.3f, 0.0f);
  const BodyId box = world.addBody({.pose = {.position = s.length * Vec3(0, 0.25f, 0)},
                                    .linear_velocity = s.speed() * Vec3(5, 0, 0),
                                    .shapes = {{Box{s.length * Vec3(0.5f, 0.25f, 0.5f)}}},
                                    .restitution = 0.0f,
                                    .friction = 0.3f});
  Curve c;
  for (int i = 1; i <= 150; ++i) {
    world.step(s.step());
    if (i % 6 == 0) c.push_back(double(world.states()[box.index].position.x()) / double(s.length));
  }
  return c;
}

// ACC-16: heights of a ball with restitution 0.8, in lengths.
Curve bouncingBall(const Scale& s) {
  World world = makeWorld(s);
  addSlab(world, s, 0.0f, 0.8f);
  const BodyId ball = world.addBody({.pose = {.position = s.length * Vec3(0, 1.25f, 0)},
                                     .shapes = {{Sphere{0.25f * s.length}}},
                                     .restitution = 0.8f,
                                     .friction = 0.0f});
  Curve c;
  for (int i = 1; i <= 150; ++i) {
    world.step(s.step());
    if (i % 6 == 0) c.push_back(double(world.states()[ball.index].position.y()) / double(s.length) - 0.25);
  }
  return c;
}

// ACC-19: how deep ten boxes sink and overlap, in lengths.
Curve stack(const Scale& s) {
  World world = makeWorld(s);
  addSlab(world, s, 0.6f, 0.0f);
  for (int i = 0; i < 10; ++i)
    world.addBody({.pose = {.position = s.length * Vec3(0, 0.5f + static_cast<float>(i), 0)},
                   .shapes = {{Box{s.length * Vec3::Constant(0.5f)}}},
                   .restitution = 0.0f,
                   .friction = 0.6f});
  Curve c;
  for (int i = 1; i <= 120; ++i) {
    world.step(s.step());
    if (i % 6 != 0) continue;
    for (uint32_t k = 1; k <= 10; ++k)
      c.push_back(double(world.states()[k].position.y()) / double(s.length) - (double(k) - 0.5));
  }
  return c;
}

// Largest distance from the curve of size 1.
double deviation(const std::function<Curve(const Scale&)>& run, float length) {
  const Curve one = run({1.0f}), other = run({length});
  double worst = 0.0;
  for (size_t i = 0; i < one.size(); ++i) worst = std::max(worst, std::abs(other[i] - one[i]));
  return worst;
}

struct ScaleCase {
  const char* name;
  Curve (*run)(const Scale&);
};

class AccScale : public testing::TestWithParam<ScaleCase> {};

// The suite allows twice the error of a case at size 1, some thousandths, and asks for 1e-2 to 1e2.
TEST_P(AccScale, NothingDependsOnTheSizeOfAScene) {
  for (const float length : {1e-3f, 1e-2f, 1e-1f, 1e1f, 1e2f, 1e3f}) {
    const double worst = deviation(GetParam().run, length);
    std::printf("  ACC-33 %s, size %g\n", GetParam().name, static_cast<double>(length));
    report("ACC-33 deviation from size 1", worst, 1e-3, "");
    EXPECT_LT(worst, 1e-3) << length;
  }
}

INSTANTIATE_TEST_SUITE_P(, AccScale,
                         testing::Values(ScaleCase{"pendulum", pendulum},
                                         ScaleCase{"sliding_box", slidingBox},
                                         ScaleCase{"bouncing_ball", bouncingBall},
                                         ScaleCase{"stack_of_10", stack}),
                         [](const auto& which) { return std::string(which.param.name); });

}  // namespace
}  // namespace pfx_test
