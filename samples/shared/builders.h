// Builders that several scenes share: the ground, and bodies in the shapes of stacks.
#pragma once

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/high_level/world/world.h"

namespace samples {

// A shape at the body's origin, or moved and turned from it.
pfx::Shape shape(const pfx::Geometry& geometry, const pfx::Transform& offset = {});

// Turn by `angle` (rad) about a unit axis.
pfx::Quat rotation(const pfx::Vec3& axis, float angle);

// Fixed box of half extent (150, 2.5, 150) m whose top is y = 0.
pfx::BodyId addGround(pfx::World& world);

// One active body of one shape; its spin dies away at 1/s, so that round bodies come to rest.
pfx::BodyId addBody(pfx::World& world, const char* name, const pfx::Geometry& geometry,
                    const pfx::Vec3& position, float mass);

// Barrel of 24 vertices along Y: three rings of eight, the middle one wider. Half height and radius 1 m.
pfx::ConvexMesh makeBarrel();

// Square bowl of gentle waves, cells x cells squares of two triangles, centred at the origin.
struct TerrainSize {
  int cells = 8;
  float half_extent = 14.0f;  // m, along X and Z
  float height = 0.8f;        // m, of the waves
  float bowl = 0.03f;         // 1/m: the rim rises by this times the square of the distance
};
pfx::LargeMesh makeTerrain(const TerrainSize& size);

struct TowerSize {
  int layers = 8;
  int boxes = 24;            // a layer
  float half_extent = 1.0f;  // m, of a box
  float mass = 0.5f;         // kg, of a box
};

// Circular tower on y = 0: rings of boxes, every other ring turned by half a box.
void addTower(pfx::World& world, const TowerSize& size);

struct WallSize {
  int rows = 7;
  float half_extent = 0.5f;  // m, of a box
  float mass = 0.5f;         // kg, of a box
};

// Triangular wall of touching boxes in the plane x = centre.x that stands on centre.y; rows run along Z.
void addWall(pfx::World& world, const pfx::Vec3& center, const WallSize& size);

struct PyramidSize {
  int rows = 20;
  float half_extent = 0.5f;  // m
  float gap = 0.02f;         // m, between the boxes of a row
  float mass = 1.0f;         // kg, of a box
};

// Pyramid of boxes in the plane z = 0 on y = 0; rows touch exactly.
void addPyramid(pfx::World& world, const PyramidSize& size);

}  // namespace samples
