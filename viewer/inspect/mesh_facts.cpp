#include "viewer/inspect/mesh_facts.h"

#include <algorithm>
#include <array>
#include <map>

#include "pfx/base_level/ray/ray.h"

namespace viewer {
namespace {

using pfx::LargeMesh;
using pfx::Vec3;
using pfx::World;

// A contact point on a triangle.
struct Touch {
  uint32_t facet;
  const pfx::Pair* pair;
  const pfx::ContactManifold* manifold;
  const pfx::ContactPoint* point;
};

std::vector<Touch> touchesOf(const World& world, uint32_t body) {
  std::vector<Touch> all;
  for (const pfx::Pair& pair : world.contactPairs()) {
    if (pair.body_a != body && pair.body_b != body) continue;
    for (const pfx::ContactManifold& m : world.manifolds(pair))
      for (int k = 0; k < m.num_points; ++k) {
        const pfx::ContactPoint& p = m.points[size_t(k)];
        all.push_back({p.triangle, &pair, &m, &p});
      }
  }
  return all;
}

FactSheet touchFacts(const World& world, uint32_t body, const Touch& touch) {
  const uint32_t other = touch.pair->body_a == body ? touch.pair->body_b : touch.pair->body_a;
  const Vec3& local = touch.pair->body_a == body ? touch.point->local_a : touch.point->local_b;
  FactSheet f;
  f.add("body", bodyRef(world, other));
  f.add("position", vectorJson(world.states()[body].pose().apply(local)), "m");
  f.add("normal", vectorJson(touch.pair->body_a == body ? touch.manifold->normal : Vec3(-touch.manifold->normal)),
        ", away from the mesh");
  f.add("distance", touch.point->distance, "m, negative: overlap");
  f.add("impulse", touch.point->normal_impulse, "N s");
  f.add("barycentric", {touch.point->barycentric.x(), touch.point->barycentric.y()}, ", (s, t)");
  return f;
}

const char* typeName(pfx::LargeMeshType type) {
  static constexpr std::array kNames = {"expanded array", "quantized array", "expanded hierarchy",
                                        "quantized hierarchy"};
  return kNames[std::min(size_t(type), kNames.size() - 1)];
}

const char* edgeName(pfx::EdgeKind kind) {
  static constexpr std::array kNames = {"flat", "convex", "concave", "open"};
  return kNames[std::min(size_t(kind), kNames.size() - 1)];
}

// How far a corner can be from where it was given: half a cell of the grid along each axis.
double quantizationError(const LargeMesh& mesh) {
  return pfx::isQuantized(mesh.type) ? 0.5 * double(mesh.grid_scale.norm()) : 0.0;
}

Json edgesJson(const LargeMesh& mesh, uint32_t facet, const pfx::MeshTriangle& t) {
  Json edges = Json::array();
  for (size_t k = 0; k < 3; ++k) {
    const uint32_t across = mesh.neighbors[facet][k];
    Json edge = {{"kind", edgeName(t.kind[k])}};
    edge["neighbor"] = across == pfx::kNoFacet ? Json() : Json(across >> 2);
    edge["sin_half_angle"] = t.tilt[k];
    edges.push_back(std::move(edge));
  }
  return edges;
}

template <class Node>
bool descend(const pfx::MeshArray<Node>& nodes, uint32_t node, uint32_t facet, std::vector<BvhStep>& path) {
  for (uint32_t i = 0; i < 8; ++i) {
    const pfx::MeshChild child = nodes[node].child[i];
    if (child == pfx::kNoChild) continue;
    path.push_back({node, i});
    if (pfx::isLeaf(child)) {
      const uint32_t first = pfx::leafFirst(child);
      if (facet >= first && facet < first + pfx::leafCount(child)) return true;
    } else if (descend(nodes, child, facet, path)) {
      return true;
    }
    path.pop_back();
  }
  return false;
}

}  // namespace

std::optional<PlacedMesh> meshOfBody(const World& world, uint32_t body) {
  if (body >= world.states().size() || !world.bodyId(body)) return std::nullopt;
  for (const pfx::Shape& shape : world.collidables()[body].shapes())
    if (const auto* mesh = std::get_if<const LargeMesh*>(&shape.geometry); mesh && *mesh)
      return PlacedMesh{*mesh, world.states()[body].pose() * shape.offset};
  return std::nullopt;
}

std::vector<uint32_t> touchedTriangles(const World& world, const pfx::Pair& pair) {
  std::vector<uint32_t> touched;
  for (const uint32_t body : {pair.body_a, pair.body_b})
    if (const auto placed = meshOfBody(world, body))
      for (const pfx::ContactManifold& m : world.manifolds(pair))
        for (int k = 0; k < m.num_points; ++k)
          if (const uint32_t facet = m.points[size_t(k)].triangle; facet < placed->mesh->numFacets())
            touched.push_back(facet);
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

std::optional<uint32_t> pickTriangle(const PlacedMesh& placed, const Ray& ray) {
  const pfx::LocalRay local = pfx::toLocal(
      {.start = ray.origin, .direction = ray.direction, .facet_mode = pfx::FacetMode::Both}, placed.pose);
  const pfx::ShapeHit hit = pfx::castRay(local, *placed.mesh);
  return hit.hit ? std::optional(hit.triangle) : std::nullopt;
}

std::vector<BvhStep> bvhPath(const LargeMesh& mesh, uint32_t facet) {
  std::vector<BvhStep> path;
  if (!mesh.nodes.empty()) descend(mesh.nodes, 0, facet, path);
  if (!mesh.quantized_nodes.empty()) descend(mesh.quantized_nodes, 0, facet, path);
  return path;
}

FactSheet meshFacts(const World& world, uint32_t body) {
  const PlacedMesh placed = *meshOfBody(world, body);
  const LargeMesh& mesh = *placed.mesh;
  FactSheet f;
  f.add("body", bodyRef(world, body));
  f.add("type", typeName(mesh.type));
  f.add("triangles", mesh.numFacets());
  f.add("islands", mesh.islands.size());
  f.add("vertices", mesh.num_source_vertices);
  f.add("nodes", mesh.nodes.size() + mesh.quantized_nodes.size(), ", of eight children each");
  f.add("bounds_min", vectorJson(mesh.surface_bounds.min), "m, mesh frame");
  f.add("bounds_max", vectorJson(mesh.surface_bounds.max), "m, mesh frame");
  f.add("thickness", mesh.max_thickness, "m, largest");
  f.add("quantization_error", quantizationError(mesh), "m, at most");
  f.add("memory", pfx::memoryBytes(mesh), "bytes");
  std::map<uint32_t, std::vector<Touch>> by_facet;
  for (const Touch& t : touchesOf(world, body))
    if (t.facet < mesh.numFacets()) by_facet[t.facet].push_back(t);
  FactList touched{"contacts", {}};
  for (const auto& [facet, touches] : by_facet)
    for (const Touch& t : touches) {
      FactSheet sheet;
      sheet.add("island", pfx::islandOf(mesh, facet));
      sheet.add("triangle", facet);
      for (Fact& fact : touchFacts(world, body, t).facts) sheet.facts.push_back(std::move(fact));
      touched.items.push_back(std::move(sheet));
    }
  f.lists.push_back(std::move(touched));
  return f;
}

FactSheet triangleFacts(const World& world, uint32_t body, uint32_t facet) {
  const PlacedMesh placed = *meshOfBody(world, body);
  const LargeMesh& mesh = *placed.mesh;
  const pfx::MeshTriangle t = pfx::meshTriangle(mesh, facet);
  const uint32_t island = pfx::islandOf(mesh, facet);
  FactSheet f;
  f.add("body", bodyRef(world, body));
  f.add("island", island);
  f.add("triangle", facet);
  f.add("in_island", facet - mesh.islands[island].first_facet, ", its number in the island");
  f.add("source", mesh.source[facet], ", triangle that it was built from");
  Json vertices = Json::array(), local = Json::array();
  for (const Vec3& v : t.vertex) {
    vertices.push_back(vectorJson(placed.pose.apply(v)));
    local.push_back(vectorJson(v));
  }
  f.add("vertices", std::move(vertices), "m, world");
  f.add("local_vertices", std::move(local), "m, mesh frame");
  f.add("normal", vectorJson(placed.pose.orientation * t.normal), ", world");
  f.add("area", 0.5f * (t.vertex[1] - t.vertex[0]).cross(t.vertex[2] - t.vertex[0]).norm(), "m2");
  f.add("edges", edgesJson(mesh, facet, t));
  f.add("thickness", t.thickness, "m");
  f.add("user_data", pfx::userData(mesh, facet));
  f.add("quantization_error", quantizationError(mesh), "m, at most");
  Json path = Json::array();
  for (const BvhStep& step : bvhPath(mesh, facet)) path.push_back({step.node, step.child});
  f.add("bvh_path", std::move(path), ", (node, child) from the root");
  FactList contacts{"contacts", {}};
  for (const Touch& touch : touchesOf(world, body))
    if (touch.facet == facet) contacts.items.push_back(touchFacts(world, body, touch));
  f.lists.push_back(std::move(contacts));
  return f;
}

}  // namespace viewer
