// Proxies, the world box, and what happens to bodies that leave it.
#include "pfx/low_level/broadphase/proxy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfx {
namespace {

Collidable unitBox() {
  Collidable c;
  c.inline_shape.geometry = Box{Vec3(1, 2, 3)};
  c.half_extent = Vec3(1, 2, 3);
  return c;
}

TEST(UpdateProxy, boundsTheTurnedBodyAndCopiesItsFilters) {
  RigidState state;
  state.position = Vec3(5, 6, 7);
  const float half_angle = std::numbers::pi_v<float> / 4.0f;  // a quarter turn about z swaps x and y
  state.orientation = Quat(std::cos(half_angle), 0, 0, std::sin(half_angle));
  state.body_id = 9, state.filter_self = 4, state.filter_target = 8, state.motion_type = MotionType::OneWay;
  BroadphaseProxy proxy;
  EXPECT_EQ(updateProxy(state, unitBox(), {}, 0.5f, proxy), Error::Ok);
  EXPECT_TRUE(proxy.bounds.halfExtent().isApprox(Vec3(2.5f, 1.5f, 3.5f), 1e-6f));  // a few roundings of 6e-8
  EXPECT_TRUE(proxy.bounds.center().isApprox(Vec3(5, 6, 7), 1e-6f));
  EXPECT_EQ(proxy.body, 9u);
  EXPECT_EQ(proxy.filter_self, 4u);
  EXPECT_EQ(proxy.filter_target, 8u);
  EXPECT_EQ(proxy.motion_type, MotionType::OneWay);
}

TEST(BodyAabb, isTightRoundPrimitivesHoweverTheyTurn) {
  Collidable sphere, capsule, unfinished;
  sphere.inline_shape.geometry = Sphere{2.0f};
  sphere.inline_shape.offset.position = Vec3(1, 0, 0);
  capsule.inline_shape.geometry = Capsule{3.0f, 0.5f};
  ASSERT_EQ(sphere.finish(), Error::Ok);
  ASSERT_EQ(capsule.finish(), Error::Ok);
  RigidState state;
  const float eighth = std::numbers::pi_v<float> / 8.0f;  // half of 45 degrees, about z
  state.orientation = Quat(std::cos(eighth), 0, 0, std::sin(eighth));
  const float r = std::sqrt(0.5f);
  const Aabb ball = bodyAabb(state, sphere), pill = bodyAabb(state, capsule);
  // A few roundings at values up to 3.
  EXPECT_TRUE(ball.center().isApprox(Vec3(r, r, 0), 1e-6f));
  EXPECT_TRUE(ball.halfExtent().isApprox(Vec3(2, 2, 2), 1e-6f));
  EXPECT_TRUE(pill.halfExtent().isApprox(Vec3(3 * r + 0.5f, 3 * r + 0.5f, 0.5f), 1e-6f));
  EXPECT_TRUE(bodyAabb(state, unfinished).halfExtent().isZero());
}

TEST(UpdateProxy, reportsBodiesOutsideTheWorldAndWritesTheProxyAllTheSame) {
  const WorldBox world{Vec3(100, 0, 0), Vec3(10, 10, 10)};
  RigidState state;
  BroadphaseProxy proxy;
  for (const auto& [x, error] : {std::pair(100.0f, Error::Ok),
                                 {110.9f, Error::Ok},
                                 {111.1f, Error::OutOfWorld},
                                 {89.1f, Error::Ok},
                                 {88.9f, Error::OutOfWorld},
                                 {NAN, Error::OutOfWorld},
                                 {INFINITY, Error::OutOfWorld}}) {
    state.position = Vec3(x, 0, 0);
    EXPECT_EQ(updateProxy(state, unitBox(), world, 0.0f, proxy), error) << x;
    EXPECT_TRUE(!std::isfinite(x) || std::abs(proxy.bounds.center().x() - x) < 1e-5f);  // one rounding at 100
  }
}

class UpdateProxies : public ::testing::Test {
 protected:
  UpdateProxies() : states(5), collidables(5, unitBox()), proxies(5) {
    for (uint32_t i = 0; i < 5; ++i) {
      states[i].position = Vec3(i == 1 || i == 3 ? 1000.0f : 0.0f, 0, 0);
      states[i].linear_velocity = Vec3(1, 2, 3);
    }
  }
  UpdateProxiesResult update(OutOfWorld behaviour) {
    return updateProxies(states, collidables, {.out_of_world = behaviour}, proxies);
  }
  std::vector<RigidState> states;
  std::vector<Collidable> collidables;
  std::vector<BroadphaseProxy> proxies;
};

TEST_F(UpdateProxies, keepsBodiesThatLeftTheWorldIfAsked) {
  const auto result = update(OutOfWorld::Keep);
  EXPECT_EQ(result.error, Error::OutOfWorld);
  EXPECT_EQ(result.num_outside, 2u);
  EXPECT_EQ(result.num_proxies, 5u);
  EXPECT_EQ(states[1].motion_type, MotionType::Active);
}

TEST_F(UpdateProxies, fixesBodiesThatLeftTheWorldIfAsked) {
  const auto result = update(OutOfWorld::FixMotion);
  EXPECT_EQ(result.num_proxies, 5u);
  for (uint32_t i : {1u, 3u}) {
    EXPECT_EQ(states[i].motion_type, MotionType::Fixed);
    EXPECT_EQ(proxies[i].motion_type, MotionType::Fixed);
    EXPECT_TRUE(states[i].linear_velocity.isZero());
  }
  EXPECT_EQ(states[0].motion_type, MotionType::Active);
}

TEST_F(UpdateProxies, removesProxiesOfBodiesThatLeftTheWorldIfAsked) {
  const auto result = update(OutOfWorld::RemoveProxy);
  ASSERT_EQ(result.num_proxies, 3u);
  EXPECT_EQ(proxies[0].body, 0u);
  EXPECT_EQ(proxies[1].body, 2u);
  EXPECT_EQ(proxies[2].body, 4u);
  EXPECT_EQ(states[1].motion_type, MotionType::Active);
}

TEST_F(UpdateProxies, refusesSpansOfDifferentLength) {
  proxies.pop_back();
  EXPECT_EQ(update(OutOfWorld::Keep).error, Error::OutOfRange);
}

TEST(AxisOfLargestVariance, isTheLongAxisOfTheCloud) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<BroadphaseProxy> proxies(10);
    for (int i = 0; i < 10; ++i) {
      Vec3 c(100.0f + 0.1f * static_cast<float>(i % 3), 50.0f, -70.0f);
      c[axis] += static_cast<float>(i);
      proxies[static_cast<std::size_t>(i)].bounds = {c, c};
    }
    EXPECT_EQ(axisOfLargestVariance(proxies), axis);
  }
  EXPECT_EQ(axisOfLargestVariance({}), 0);
}

}  // namespace
}  // namespace pfx
