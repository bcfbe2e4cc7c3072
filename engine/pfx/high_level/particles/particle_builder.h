// Ropes, hair, cloth and soft solids as particles and constraints.
//
// Each function appends to a definition and returns the index of its first particle.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "pfx/high_level/particles/particle_def.h"

namespace pfx {

struct RopeShape {
  Vec3 from = Vec3::Zero(), to = Vec3::UnitX();  // m, of the first and the last particle
  int particles = 16;                            // >= 2
  float mass = 1.0f;                             // kg, of all together
  float bending_stiffness = 0.0f;                // N m^2, EI; 0: limp
};
// One strand of equal links. Particle k of the rope is the first plus k.
uint32_t addRope(ParticleDef& def, const RopeShape& shape);

// Bending along particles that were added one after the other and stand at their rest shape.
void addBending(ParticleDef& def, std::span<const uint32_t> particles, float bending_stiffness);

struct ClothShape {
  Vec3 corner = Vec3::Zero();                              // m
  Vec3 along = Vec3::UnitX(), across = Vec3::UnitZ();  // m, two edges from the corner
  int columns = 32, rows = 32;                             // particles, >= 2; columns lie along
  float mass = 0.2f;                                       // kg
  float shear_compliance = 1e-3f;                          // m/N, of the diagonals
  float bending_stiffness = 0.0f;                          // N m^2, of each thread
};
// Threads along and across as strands, one diagonal each way in every cell. The particle of row r and column c is the
// first plus r * columns + c.
uint32_t addCloth(ParticleDef& def, const ClothShape& shape);

// Triangles of a cloth, counter-clockwise seen from the side that along x across points away from.
std::vector<uint32_t> clothTriangles(int columns, int rows, uint32_t first = 0);

struct SoftBoxShape {
  Vec3 center = Vec3::Zero();            // m
  Vec3 half_extent = Vec3::Ones();       // m
  std::array<int, 3> cells = {4, 4, 4};  // >= 1
  float mass = 1.0f;                     // kg
  float edge_compliance = 1e-4f;         // m/N
  float volume_compliance = 0.0f;        // 1/(Pa m^3)
  // Moves a point of the box (m) before lengths and volumes are measured, e.g. to make a ball of it.
  std::function<Vec3(const Vec3&)> shape = {};
};
struct SoftBox {
  uint32_t first;                   // particle
  std::vector<uint32_t> triangles;  // of the surface, counter-clockwise seen from outside
};
// Five tetrahedra in every cell, with distances along their edges.
SoftBox addSoftBox(ParticleDef& def, const SoftBoxShape& shape);

}  // namespace pfx
