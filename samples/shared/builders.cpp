#include "samples/shared/builders.h"

#include "pfx/base_level/math/trig.h"

namespace samples {

using namespace pfx;

Shape shape(const Geometry& geometry, const Transform& offset) { return {geometry, offset}; }

BodyId addGround(World& world) {
  return world.addBody({.name = "ground",
                        .pose = {.position = Vec3(0.0f, -2.5f, 0.0f)},
                        .motion_type = MotionType::Fixed,
                        .shapes = {shape(Box{Vec3(150.0f, 2.5f, 150.0f)})}});
}

BodyId addBody(World& world, const char* name, const Geometry& geometry, const Vec3& position, float mass) {
  return world.addBody({.name = name, .pose = {.position = position}, .shapes = {shape(geometry)}, .mass = mass});
}

void addTower(World& world, const TowerSize& size) {
  const float radius = 1.3f * static_cast<float>(size.boxes) / kPi * size.half_extent;
  const float step = 2.0f * kPi / static_cast<float>(size.boxes);
  for (int layer = 0; layer < size.layers; ++layer) {
    for (int i = 0; i < size.boxes; ++i) {
      const float angle = (static_cast<float>(i) + 0.5f * static_cast<float>(layer % 2)) * step;
      const SinCos turn = sincos(angle), half = sincos(0.5f * angle);
      const float y = (2.0f * static_cast<float>(layer) + 1.0f) * size.half_extent;
      world.addBody({.name = "brick " + std::to_string(layer) + "/" + std::to_string(i),
                     .pose = {.position = Vec3(radius * turn.sin, y, radius * turn.cos),
                              .orientation = Quat(half.cos, 0.0f, half.sin, 0.0f)},
                     .shapes = {shape(Box{Vec3::Constant(size.half_extent)})},
                     .mass = size.mass});
    }
  }
}

void addPyramid(World& world, const PyramidSize& size) {
  const float pitch = 2.0f * size.half_extent + size.gap;
  for (int row = 0; row < size.rows; ++row) {
    const int count = size.rows - row;
    for (int i = 0; i < count; ++i) {
      const float x = (static_cast<float>(i) - 0.5f * static_cast<float>(count - 1)) * pitch;
      const float y = (2.0f * static_cast<float>(row) + 1.0f) * size.half_extent;
      world.addBody({.name = "box " + std::to_string(row) + "/" + std::to_string(i),
                     .pose = {.position = Vec3(x, y, 0.0f)},
                     .shapes = {shape(Box{Vec3::Constant(size.half_extent)})},
                     .mass = size.mass});
    }
  }
}

}  // namespace samples
