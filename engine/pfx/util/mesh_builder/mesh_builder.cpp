// Building = cleaning the soup, ordering it by the hierarchy, storing its topology; replaceVertices does the rest.
#include "pfx/util/mesh_builder/mesh_builder.h"

#include <algorithm>
#include <cmath>

#include "pfx/util/mesh_builder/mesh_hierarchy.h"
#include "pfx/util/mesh_builder/mesh_refit.h"
#include "pfx/util/mesh_builder/mesh_topology.h"

namespace pfx {
namespace {

struct Problem {
  Error error = Error::Ok;
  uint32_t where = 0;
};

bool validThickness(float t) { return std::isfinite(t) && t >= 0.0f; }

Problem checkInput(std::span<const Vec3> vertices, std::span<const uint32_t> indices, const LargeMeshOptions& options) {
  if (vertices.empty() || indices.empty()) return {Error::Degenerate, 0};
  const size_t n = indices.size() / 3;
  if (indices.size() % 3 != 0 || n > kMaxFacets) return {Error::OutOfRange, static_cast<uint32_t>(indices.size())};
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= vertices.size()) return {Error::OutOfRange, static_cast<uint32_t>(i / 3)};
  }
  for (size_t i = 0; i < vertices.size(); ++i) {
    if (!validPosition(vertices[i])) return {Error::InvalidValue, static_cast<uint32_t>(i)};
  }
  for (const size_t length : {options.triangle_thickness.size(), options.user_data.size()}) {
    if (length != 0 && length != n) return {Error::OutOfRange, static_cast<uint32_t>(length)};
  }
  if (!validThickness(options.thickness)) return {Error::InvalidValue, 0};
  for (size_t i = 0; i < options.triangle_thickness.size(); ++i) {
    if (!validThickness(options.triangle_thickness[i])) return {Error::InvalidValue, static_cast<uint32_t>(i)};
  }
  return {};
}

// Triangles that count, with the numbers they were given under.
struct Soup {
  std::vector<MeshIndices> triangles;
  std::vector<uint32_t> source;
  uint32_t degenerate = 0, duplicate = 0;
};

Soup cleanSoup(std::span<const Vec3> vertices, std::span<const uint32_t> indices, bool weld) {
  Soup soup;
  std::vector<uint32_t> welded;
  if (weld) welded = weldVertices(vertices);
  soup.triangles.reserve(indices.size() / 3);
  soup.source.reserve(indices.size() / 3);
  for (uint32_t i = 0; i < indices.size() / 3; ++i) {
    MeshIndices t = {indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]};
    if (isDegenerate(vertices[t[0]], vertices[t[1]], vertices[t[2]])) {
      ++soup.degenerate;
      continue;
    }
    if (weld) t = {welded[t[0]], welded[t[1]], welded[t[2]]};
    soup.triangles.push_back(t);
    soup.source.push_back(i);
  }
  soup.duplicate = dropDuplicates(soup.triangles, soup.source, static_cast<uint32_t>(vertices.size()));
  return soup;
}

std::vector<BuildItem> buildItems(std::span<const Vec3> vertices, const Soup& soup) {
  std::vector<BuildItem> items(soup.triangles.size());
  for (uint32_t i = 0; i < items.size(); ++i) {
    Aabb box;
    for (const uint32_t v : soup.triangles[i]) box.extend(vertices[v]);
    items[i] = {{box.min.x(), box.min.y(), box.min.z()}, i, {box.max.x(), box.max.y(), box.max.z()}, 0.0f};
  }
  return items;
}

void reorder(Soup& soup, std::span<const BuildItem> items) {
  Soup sorted = soup;
  for (size_t i = 0; i < items.size(); ++i) {
    sorted.triangles[i] = soup.triangles[items[i].id];
    sorted.source[i] = soup.source[items[i].id];
  }
  soup = std::move(sorted);
}

// Vertices in the order of their first use, so that neighbours in space are neighbours in memory.
void storeExpanded(LargeMesh& mesh, const Soup& soup) {
  std::vector<uint32_t> place(mesh.num_source_vertices, kNoFacet);
  mesh.triangles.resize(soup.triangles.size());
  for (size_t f = 0; f < soup.triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      uint32_t& p = place[soup.triangles[f][k]];
      if (p == kNoFacet) {
        p = static_cast<uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back({Vec3::Zero(), soup.triangles[f][k]});
      }
      mesh.triangles[f][k] = p;
    }
  }
  mesh.vertices.shrink_to_fit();
  mesh.facets.resize(soup.triangles.size());
}

// Each block of 64 facets lists its own vertices, so that 8 bits name one of at most 192.
void storeQuantized(LargeMesh& mesh, const Soup& soup) {
  mesh.quantized_facets.resize(soup.triangles.size());
  for (size_t f = 0; f < soup.triangles.size(); ++f) {
    if (f % kMaxIslandFacets == 0) mesh.vertex_blocks.push_back(static_cast<uint32_t>(mesh.vertex_source.size()));
    const size_t block = mesh.vertex_blocks.back();
    for (int k = 0; k < 3; ++k) {
      const uint32_t v = soup.triangles[f][k];
      size_t place = block;
      while (place < mesh.vertex_source.size() && mesh.vertex_source[place] != v) ++place;
      if (place == mesh.vertex_source.size()) mesh.vertex_source.push_back(v);
      mesh.quantized_facets[f].vertex[k] = static_cast<uint8_t>(place - block);
    }
  }
  mesh.vertex_source.shrink_to_fit();
  mesh.quantized_vertices.resize(mesh.vertex_source.size());
}

void storeThickness(LargeMesh& mesh, const LargeMeshOptions& options) {
  const auto thickness = [&](uint32_t facet) {
    return options.triangle_thickness.empty() ? options.thickness : options.triangle_thickness[mesh.source[facet]];
  };
  mesh.max_thickness = 0.0f;
  for (uint32_t f = 0; f < mesh.numFacets(); ++f) mesh.max_thickness = std::max(mesh.max_thickness, thickness(f));
  for (uint32_t f = 0; f < mesh.numFacets(); ++f) {
    if (isQuantized(mesh.type)) {
      const float part = mesh.max_thickness > 0.0f ? thickness(f) / mesh.max_thickness : 0.0f;
      mesh.quantized_facets[f].thickness = static_cast<uint16_t>(std::lround(part * 65535.0f));
    } else {
      mesh.facets[f].thickness = thickness(f);
    }
  }
}

void storeNodes(LargeMesh& mesh, const std::vector<BinaryNode>& tree) {
  const auto children = collapse(tree);
  const auto copy = [&](auto& nodes) {
    nodes.resize(children.size());
    for (size_t i = 0; i < children.size(); ++i) std::copy_n(children[i].begin(), 8, nodes[i].child);
  };
  if (isQuantized(mesh.type)) {
    copy(mesh.quantized_nodes);
  } else {
    copy(mesh.nodes);
  }
}

void storeIslands(LargeMesh& mesh, const std::vector<uint32_t>& firsts) {
  for (size_t i = 0; i < firsts.size(); ++i) {
    const uint32_t end = i + 1 < firsts.size() ? firsts[i + 1] : mesh.numFacets();
    mesh.islands.push_back({firsts[i], end - firsts[i], {}});
  }
}

// Above this many triangles more islands than need be are no matter; below, every island but the last is full, so that
// a mesh of 512 x 64 triangles has 512 islands.
constexpr size_t kFullIslandsBelow = 32768, kMostIslandsBelow = 512;

// The tree, with the items in the order of its leaves. Islands that end where the tree divides are tighter than full ones:
// high quality has them, unless they would be too many.
std::vector<BinaryNode> hierarchyOf(std::span<BuildItem> items, const LargeMeshOptions& options) {
  const bool small = items.size() <= kFullIslandsBelow;
  if (!options.high_quality) return buildHierarchy(items, {.full_islands = !hasBvh(options.type) || small});
  HierarchyOptions how{.bins = 32, .all_axes = true};
  std::vector<BinaryNode> tree = buildHierarchy(items, how);
  if (!small || cutIslands(tree).size() <= kMostIslandsBelow) return tree;
  how.full_islands = true;
  return buildHierarchy(items, how);
}

}  // namespace

LargeMeshResult buildLargeMesh(std::span<const Vec3> vertices, std::span<const uint32_t> indices,
                               const LargeMeshOptions& options) {
  LargeMeshResult result;
  const Problem problem = checkInput(vertices, indices, options);
  result.error = problem.error;
  result.where = problem.where;
  if (result.error != Error::Ok) return result;

  Soup soup = cleanSoup(vertices, indices, options.weld);
  result.dropped_degenerate = soup.degenerate;
  result.dropped_duplicate = soup.duplicate;
  if (soup.triangles.empty()) {
    result.error = Error::Degenerate;
    return result;
  }

  std::vector<BuildItem> items = buildItems(vertices, soup);
  const std::vector<BinaryNode> tree = hierarchyOf(items, options);
  reorder(soup, items);

  LargeMesh& mesh = result.mesh;
  mesh.type = options.type;
  mesh.num_source_vertices = static_cast<uint32_t>(vertices.size());
  const std::vector<MeshIndices> neighbors = findNeighbors(soup.triangles, mesh.num_source_vertices);
  mesh.neighbors.assign(neighbors.begin(), neighbors.end());
  if (isQuantized(mesh.type)) {
    storeQuantized(mesh, soup);
  } else {
    storeExpanded(mesh, soup);
  }
  mesh.source.assign(soup.source.begin(), soup.source.end());
  if (!options.user_data.empty()) {
    mesh.user_data.resize(mesh.numFacets());
    for (uint32_t f = 0; f < mesh.numFacets(); ++f) mesh.user_data[f] = options.user_data[mesh.source[f]];
  }
  storeThickness(mesh, options);
  storeIslands(mesh, cutIslands(tree));
  if (hasBvh(mesh.type)) storeNodes(mesh, tree);
  result.error = replaceVertices(mesh, vertices);
  return result;
}

}  // namespace pfx
