// Falling piles of convex hulls, where most pairs are near and few touch: a survey of another engine measured 2.0 to
// 2.7 us a pair in them.
#pragma once

#include <cmath>
#include <vector>

#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/high_level/world/world.h"

namespace pfx_test {

using namespace pfx;

inline constexpr float kStep = 1.0f / 60.0f;

inline ConvexMesh hull(const std::vector<Vec3>& points) {
  ConvexMesh mesh;
  buildConvexMesh(points, mesh);
  return mesh;
}

// 32 points on a sphere of radius 2 m.
inline ConvexMesh roundHull() {
  std::vector<Vec3> points;
  uint32_t random = 12345;
  const auto next = [&] {
    return static_cast<float>((random = random * 1664525u + 1013904223u) >> 8) * 0x1p-23f - 1.0f;
  };
  while (points.size() < 32) {
    const float x = next(), y = next(), z = next();
    const Vec3 p(x, y, z);
    if (p.norm() > 0.1f) points.push_back(2.0f * p.normalized());
  }
  return hull(points);
}

// Ten points of a Fibonacci lattice on a sphere of radius 1.5 m.
inline ConvexMesh rock() {
  std::vector<Vec3> points;
  for (int i = 0; i < 10; ++i) {
    const float z = 1.0f - static_cast<float>(2 * i + 1) / 10.0f, r = std::sqrt(1.0f - z * z);
    const float azimuth = 6.2831853f / 1.6180340f * static_cast<float>(i);
    points.push_back(1.5f * Vec3(r * std::cos(azimuth), r * std::sin(azimuth), z));
  }
  return hull(points);
}

inline void addFixedBox(World& world, const Vec3& position, const Vec3& half_extent) {
  world.addBody(
      {.pose = {.position = position}, .motion_type = MotionType::Fixed, .shapes = {{Box{half_extent}, {}}}});
}

// 8 x 8 columns of round hulls, 80 high.
inline World convexPile() {
  World world;
  addFixedBox(world, Vec3(0, -1, 0), Vec3(250, 1, 250));
  const ConvexMesh* mesh = world.keep(roundHull());
  for (int y = 0; y < 80; ++y)
    for (int i = 0; i < 64; ++i)
      world.addBody(
          {.pose = {.position = 4.0f * Vec3(static_cast<float>(i % 8 - 4), static_cast<float>(y) + 0.5f,
                                            static_cast<float>(i / 8 - 4))},
           .shapes = {{mesh, {}}},
           .mass = 1000.0f * mesh->volume,
           .restitution = 0.0f});
  return world;
}

// 21 x 21 columns of rocks, 24 high, in a walled yard; the pusher stands still.
inline World junkyard() {
  World world;
  addFixedBox(world, Vec3(0, -1, 0), Vec3(120, 1, 120));
  for (const float side : {-50.0f, 50.0f}) {
    addFixedBox(world, Vec3(side, 7, 0), Vec3(1, 8, 50));
    addFixedBox(world, Vec3(0, 7, side), Vec3(50, 8, 1));
  }
  const ConvexMesh* mesh = world.keep(rock());
  for (int y = 0; y < 24; ++y)
    for (int i = 0; i < 441; ++i)
      world.addBody({.pose = {.position = Vec3(4.0f * static_cast<float>(i % 21) - 40.0f,
                                               4.0f * static_cast<float>(y) + 25.0f,
                                               4.0f * static_cast<float>(i / 21) - 40.0f)},
                     .shapes = {{mesh, {}}},
                     .mass = 1000.0f * mesh->volume,
                     .restitution = 0.0f});
  return world;
}

}  // namespace pfx_test
