// Triangle soups for tests and benchmarks: grids, an icosphere, a bumpy field.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "pfx/base_level/math/vector.h"

namespace pfx_test {

struct Soup {
  std::vector<pfx::Vec3> vertices;
  std::vector<uint32_t> indices;
  uint32_t numTriangles() const { return static_cast<uint32_t>(indices.size() / 3); }
};

// n x n squares of the given edge in the plane y = height(x, z), centred on the origin, front up. The diagonal of each
// square alternates pseudo-randomly.
template <class Height>
Soup grid(int n, float edge, Height&& height) {
  Soup soup;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const float x = (static_cast<float>(i) - 0.5f * static_cast<float>(n)) * edge;
      const float z = (static_cast<float>(j) - 0.5f * static_cast<float>(n)) * edge;
      soup.vertices.emplace_back(x, height(x, z), z);
    }
  }
  uint32_t random = 12345;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const uint32_t a = static_cast<uint32_t>(j * (n + 1) + i), b = a + 1, c = a + static_cast<uint32_t>(n) + 1, d = c + 1;
      random = random * 1664525u + 1013904223u;
      const bool flip = (random >> 16 & 1) != 0;
      const std::array<uint32_t, 6> square =
          flip ? std::array{a, c, b, b, c, d} : std::array{a, c, d, a, d, b};
      soup.indices.insert(soup.indices.end(), square.begin(), square.end());
    }
  }
  return soup;
}

inline Soup flatGrid(int n, float edge) {
  return grid(n, edge, [](float, float) { return 0.0f; });
}

// Smooth hills with detail, amplitude about 1.5 m.
inline Soup bumpyGrid(int n, float edge) {
  return grid(n, edge, [](float x, float z) {
    return std::sin(0.31f * x) * std::cos(0.27f * z) + 0.5f * std::sin(1.3f * x + 0.7f * z);
  });
}

// A closed sphere of 20 * frequency^2 triangles, front outside.
inline Soup icosphere(int frequency, float radius) {
  const float p = 0.5f * (1.0f + std::sqrt(5.0f));
  const pfx::Vec3 corner[12] = {{-1, p, 0}, {1, p, 0}, {-1, -p, 0}, {1, -p, 0}, {0, -1, p}, {0, 1, p},
                                {0, -1, -p}, {0, 1, -p}, {p, 0, -1}, {p, 0, 1}, {-p, 0, -1}, {-p, 0, 1}};
  const int face[20][3] = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                           {11, 10, 2}, {10, 7, 6}, {7, 1, 8}, {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8},
                           {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
  Soup soup;
  // A vertex is named by its weights on the twelve corners, so that faces share those on their borders.
  using Name = std::vector<std::pair<int, int>>;
  std::map<Name, uint32_t> known;
  const auto vertex = [&](const int* f, int a, int b) {
    const int weight[3] = {frequency - a - b, a, b};
    Name name;
    for (int k = 0; k < 3; ++k) {
      if (weight[k] > 0) name.emplace_back(f[k], weight[k]);
    }
    std::sort(name.begin(), name.end());
    const auto [it, added] = known.try_emplace(name, static_cast<uint32_t>(soup.vertices.size()));
    if (added) {
      pfx::Vec3 sum = pfx::Vec3::Zero();
      for (const auto& [c, w] : name) sum += static_cast<float>(w) * corner[c];
      soup.vertices.push_back(radius * sum.normalized());
    }
    return it->second;
  };
  for (const auto& f : face) {
    for (int a = 0; a < frequency; ++a) {
      for (int b = 0; a + b < frequency; ++b) {
        for (const uint32_t v : {vertex(f, a, b), vertex(f, a + 1, b), vertex(f, a, b + 1)}) soup.indices.push_back(v);
        if (a + b + 1 == frequency) continue;
        for (const uint32_t v : {vertex(f, a + 1, b), vertex(f, a + 1, b + 1), vertex(f, a, b + 1)}) {
          soup.indices.push_back(v);
        }
      }
    }
  }
  return soup;
}

}  // namespace pfx_test
