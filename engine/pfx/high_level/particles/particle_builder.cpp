#include "pfx/high_level/particles/particle_builder.h"

#include <algorithm>
#include <set>
#include <span>

namespace pfx {
namespace {

uint32_t numParticles(const ParticleDef& def) { return static_cast<uint32_t>(def.positions.size()); }

void addParticle(ParticleDef& def, const Vec3& position, float mass) {
  def.positions.push_back(position);
  def.masses.push_back(mass);
}

// A thread of particles first, first + step, ...
void addThread(ParticleDef& def, uint32_t first, uint32_t step, int count, float bending_stiffness) {
  ParticleStrand strand;
  for (int k = 0; k < count; ++k) strand.particles.push_back(first + static_cast<uint32_t>(k) * step);
  if (bending_stiffness > 0.0f) addBending(def, strand.particles, bending_stiffness);
  def.strands.push_back(std::move(strand));
}

float tetrahedronSign(const ParticleDef& def, const VolumeConstraint& t) {
  const auto& x = def.positions;
  return (x[t.b] - x[t.a]).cross(x[t.c] - x[t.a]).dot(x[t.d] - x[t.a]);
}

// A lattice of particles, and the numbers of its corners.
struct Lattice {
  uint32_t first;
  std::array<int, 3> cells;
  uint32_t at(int i, int j, int k) const {
    return first + static_cast<uint32_t>((i * (cells[1] + 1) + j) * (cells[2] + 1) + k);
  }
};

// The tetrahedra of a cell; neighbours are mirror images, so that their faces fit.
void addCell(ParticleDef& def, const Lattice& lattice, int i, int j, int k, float compliance) {
  std::array<uint32_t, 8> corner{};
  for (int c = 0; c < 8; ++c) corner[c] = lattice.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
  constexpr int kTetrahedra[5][4] = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
  const int mirror = (i + j + k) % 2 == 0 ? 0 : 1;  // swaps corners along x
  for (const auto& t : kTetrahedra) {
    VolumeConstraint v{.a = corner[t[0] ^ mirror],
                       .b = corner[t[1] ^ mirror],
                       .c = corner[t[2] ^ mirror],
                       .d = corner[t[3] ^ mirror],
                       .compliance = compliance};
    if (tetrahedronSign(def, v) < 0.0f) std::swap(v.c, v.d);
    def.volumes.push_back(v);
  }
}

void addEdges(ParticleDef& def, size_t first_volume, float compliance) {
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = first_volume; i < def.volumes.size(); ++i) {
    const VolumeConstraint& v = def.volumes[i];
    const std::array<uint32_t, 4> p = {v.a, v.b, v.c, v.d};
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) edges.insert(std::minmax(p[a], p[b]));
  }
  for (const auto& [a, b] : edges) def.distances.push_back({.a = a, .b = b, .compliance = compliance});
}

// Faces of tetrahedra that belong to one of them only.
std::vector<uint32_t> surfaceOf(std::span<const VolumeConstraint> volumes) {
  struct Face {
    std::array<uint32_t, 3> sorted, corners;
  };
  std::vector<Face> faces;
  for (const VolumeConstraint& v : volumes)
    for (const std::array<uint32_t, 3>& f :
         {std::array{v.b, v.c, v.d}, std::array{v.a, v.d, v.c}, std::array{v.a, v.b, v.d}, std::array{v.a, v.c, v.b}}) {
      std::array<uint32_t, 3> sorted = f;
      std::sort(sorted.begin(), sorted.end());
      faces.push_back({sorted, f});
    }
  std::stable_sort(faces.begin(), faces.end(), [](const Face& x, const Face& y) { return x.sorted < y.sorted; });
  std::vector<uint32_t> out;
  for (size_t i = 0; i < faces.size(); ++i) {
    const bool is_shared = (i > 0 && faces[i - 1].sorted == faces[i].sorted) ||
                           (i + 1 < faces.size() && faces[i + 1].sorted == faces[i].sorted);
    if (!is_shared) out.insert(out.end(), faces[i].corners.begin(), faces[i].corners.end());
  }
  return out;
}

}  // namespace

void addBending(ParticleDef& def, std::span<const uint32_t> particles, float bending_stiffness) {
  for (size_t k = 1; k + 1 < particles.size(); ++k) {
    const float length = 0.5f * ((def.positions[particles[k]] - def.positions[particles[k - 1]]).norm() +
                                 (def.positions[particles[k + 1]] - def.positions[particles[k]]).norm());
    def.angles.push_back({.a = particles[k - 1],
                          .b = particles[k],
                          .c = particles[k + 1],
                          .compliance = length / bending_stiffness});
  }
}

uint32_t addRope(ParticleDef& def, const RopeShape& s) {
  const uint32_t first = numParticles(def);
  for (int k = 0; k < s.particles; ++k)
    addParticle(def, s.from + static_cast<float>(k) / static_cast<float>(s.particles - 1) * (s.to - s.from),
                s.mass / static_cast<float>(s.particles));
  addThread(def, first, 1, s.particles, s.bending_stiffness);
  return first;
}

uint32_t addCloth(ParticleDef& def, const ClothShape& s) {
  const uint32_t first = numParticles(def);
  for (int r = 0; r < s.rows; ++r)
    for (int c = 0; c < s.columns; ++c)
      addParticle(def,
                  s.corner + static_cast<float>(c) / static_cast<float>(s.columns - 1) * s.along +
                      static_cast<float>(r) / static_cast<float>(s.rows - 1) * s.across,
                  s.mass / static_cast<float>(s.columns * s.rows));
  const auto at = [&](int r, int c) { return first + static_cast<uint32_t>(r * s.columns + c); };
  for (int r = 0; r < s.rows; ++r) addThread(def, at(r, 0), 1, s.columns, s.bending_stiffness);
  for (int c = 0; c < s.columns; ++c)
    addThread(def, at(0, c), static_cast<uint32_t>(s.columns), s.rows, s.bending_stiffness);
  for (int r = 0; r + 1 < s.rows; ++r)
    for (int c = 0; c + 1 < s.columns; ++c) {
      def.distances.push_back({.a = at(r, c), .b = at(r + 1, c + 1), .compliance = s.shear_compliance});
      def.distances.push_back({.a = at(r, c + 1), .b = at(r + 1, c), .compliance = s.shear_compliance});
    }
  return first;
}

std::vector<uint32_t> clothTriangles(int columns, int rows, uint32_t first) {
  std::vector<uint32_t> out;
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      const auto at = [&](int i, int k) { return first + static_cast<uint32_t>((r + i) * columns + c + k); };
      if ((r + c) % 2 == 0)
        out.insert(out.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
      else
        out.insert(out.end(), {at(0, 0), at(1, 0), at(0, 1), at(0, 1), at(1, 0), at(1, 1)});
    }
  return out;
}

SoftBox addSoftBox(ParticleDef& def, const SoftBoxShape& s) {
  const Lattice lattice{numParticles(def), s.cells};
  const size_t first_volume = def.volumes.size();
  const auto total = static_cast<float>((s.cells[0] + 1) * (s.cells[1] + 1) * (s.cells[2] + 1));
  for (int i = 0; i <= s.cells[0]; ++i)
    for (int j = 0; j <= s.cells[1]; ++j)
      for (int k = 0; k <= s.cells[2]; ++k) {
        const Vec3 share(static_cast<float>(i) / static_cast<float>(s.cells[0]),
                         static_cast<float>(j) / static_cast<float>(s.cells[1]),
                         static_cast<float>(k) / static_cast<float>(s.cells[2]));
        const Vec3 point = s.half_extent.cwiseProduct(2.0f * share - Vec3::Ones());
        addParticle(def, s.center + (s.shape ? s.shape(point) : point), s.mass / total);
      }
  for (int i = 0; i < s.cells[0]; ++i)
    for (int j = 0; j < s.cells[1]; ++j)
      for (int k = 0; k < s.cells[2]; ++k) addCell(def, lattice, i, j, k, s.volume_compliance);
  addEdges(def, first_volume, s.edge_compliance);
  return {lattice.first, surfaceOf(std::span(def.volumes).subspan(first_volume))};
}

}  // namespace pfx
