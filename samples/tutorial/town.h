// A small town as one mesh of about two thousand triangles: a square with a fountain, streets with houses, a
// bank with stairs, and a church above them. Every triangle carries what it belongs to.
#pragma once

#include <span>
#include <vector>

#include "pfx/base_level/shape/large_mesh.h"
#include "samples/canvas.h"

namespace samples {

enum class TownPart : uint32_t { Grass, Paving, Wall, Roof, Stone, Step, Water };
inline constexpr int kNumTownParts = 7;

std::string_view toString(TownPart part);

struct Town {
  std::vector<pfx::Vec3> points;
  std::vector<uint32_t> indices;    // three a triangle
  std::vector<uint32_t> user_data;  // by triangle: triangle << 3 | part

  // What is painted on the walls and is no part of the mesh: doors and windows, four corners each.
  std::vector<pfx::Vec3> window_points;
  std::vector<uint32_t> window_indices;

  size_t numTriangles() const { return indices.size() / 3; }
};

inline constexpr TownPart partOf(uint32_t user_data) { return static_cast<TownPart>(user_data & 7u); }

Town makeTown();

// Quantized, with a bounding volume hierarchy and user data.
pfx::LargeMesh makeTownMesh(const Town& town);

// m, of the ground without houses.
float townGround(float x, float z);

// The town in its colours: one surface a part, a little outside of the mesh.
class TownPainter {
 public:
  explicit TownPainter(const Town& town);
  void draw(Canvas& canvas) const;

 private:
  struct Coat {
    std::vector<pfx::Vec3> points;
    std::vector<uint32_t> indices;
  };
  Coat coats_[kNumTownParts], windows_;
};

}  // namespace samples
