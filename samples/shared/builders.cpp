#include "samples/shared/builders.h"

#include <stdexcept>

#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace samples {

using namespace pfx;

Shape shape(const Geometry& geometry, const Transform& offset) { return {geometry, offset}; }

Quat rotation(const Vec3& axis, float angle) {
  const SinCos half = sincos(0.5f * angle);
  return Quat(half.cos, half.sin * axis.x(), half.sin * axis.y(), half.sin * axis.z());
}

BodyId addGround(World& world) {
  return world.addBody({.name = "ground",
                        .pose = {.position = Vec3(0.0f, -2.5f, 0.0f)},
                        .motion_type = MotionType::Fixed,
                        .shapes = {shape(Box{Vec3(150.0f, 2.5f, 150.0f)})}});
}

BodyId addBody(World& world, const char* name, const Geometry& geometry, const Vec3& position, float mass) {
  return world.addBody({.name = name,
                        .pose = {.position = position},
                        .shapes = {shape(geometry)},
                        .mass = mass,
                        .angular_damping = 1.0f});
}

ConvexMesh makeBarrel() {
  std::vector<Vec3> points;
  for (int ring = -1; ring <= 1; ++ring) {
    for (int i = 0; i < 8; ++i) {
      const SinCos turn = sincos(0.25f * kPi * static_cast<float>(i));
      const float radius = ring == 0 ? 1.0f : 0.75f;
      points.push_back(Vec3(radius * turn.cos, static_cast<float>(ring), radius * turn.sin));
    }
  }
  ConvexMesh mesh;
  if (buildConvexMesh(points, mesh) != Error::Ok) throw std::logic_error("the barrel is not a convex mesh");
  return mesh;
}

LargeMesh makeTerrain(const TerrainSize& size) {
  const int side = size.cells + 1;
  const float pitch = 2.0f * size.half_extent / static_cast<float>(size.cells);
  std::vector<Vec3> vertices;
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      const float x = static_cast<float>(i) * pitch - size.half_extent;
      const float z = static_cast<float>(k) * pitch - size.half_extent;
      const float waves = size.height * sin(0.55f * x) * cos(0.5f * z);
      vertices.push_back(Vec3(x, waves + size.bowl * (x * x + z * z), z));
    }
  }
  std::vector<uint32_t> indices;
  for (int i = 0; i < size.cells; ++i) {
    for (int k = 0; k < size.cells; ++k) {
      const auto at = [&](int di, int dk) { return static_cast<uint32_t>((i + di) * side + k + dk); };
      indices.insert(indices.end(), {at(0, 0), at(0, 1), at(1, 0), at(1, 0), at(0, 1), at(1, 1)});
    }
  }
  LargeMeshResult built = buildLargeMesh(vertices, indices);
  if (built.error != Error::Ok) throw std::logic_error("the terrain is not a mesh");
  return std::move(built.mesh);
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

void addWall(World& world, const Vec3& center, const WallSize& size) {
  for (int row = 0; row < size.rows; ++row) {
    const int count = size.rows - row;
    for (int i = 0; i < count; ++i) {
      const float z = (2.0f * static_cast<float>(i) - static_cast<float>(count - 1)) * size.half_extent;
      const float y = (2.0f * static_cast<float>(row) + 1.0f) * size.half_extent;
      world.addBody({.name = "block " + std::to_string(row) + "/" + std::to_string(i),
                     .pose = {.position = center + Vec3(0.0f, y, z)},
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
