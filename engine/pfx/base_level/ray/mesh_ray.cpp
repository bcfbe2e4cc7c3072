// Rays against large meshes: the part inside the bounds goes through a kernel; the hit is then computed in doubles.
#include "pfx/base_level/ray/mesh_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {
namespace {

using Vec3d = Eigen::Vector3d;

MeshRayView viewOf(const LargeMesh& mesh) {
  MeshRayView v;
  v.nodes = isQuantized(mesh.type) ? reinterpret_cast<const char*>(mesh.quantized_nodes.data())
                                   : reinterpret_cast<const char*>(mesh.nodes.data());
  v.vertices = reinterpret_cast<const float*>(mesh.vertices.data());
  v.triangles = reinterpret_cast<const uint32_t(*)[3]>(mesh.triangles.data());
  v.quantized_vertices = reinterpret_cast<const uint16_t(*)[3]>(mesh.quantized_vertices.data());
  v.vertex_blocks = mesh.vertex_blocks.data();
  v.quantized_facets = reinterpret_cast<const char*>(mesh.quantized_facets.data());
  v.source = mesh.source.data();
  for (int a = 0; a < 3; ++a) v.origin[a] = mesh.surface_bounds.min[a], v.scale[a] = mesh.grid_scale[a];
  return v;
}

struct Range {
  double first, last;
};

// Fractions between which the ray is inside the box, a little more on both sides.
Range insideBox(const LocalRay& ray, const Aabb& box, double pad) {
  Range r = {0.0, ray.max_fraction};
  for (int a = 0; a < 3; ++a) {
    const double lo = box.min[a] - pad - ray.start[a], hi = box.max[a] + pad - ray.start[a], d = ray.direction[a];
    if (d == 0.0) {
      if (lo > 0.0 || hi < 0.0) return {1.0, 0.0};
      continue;
    }
    const double t0 = lo / d, t1 = hi / d;
    r.first = std::max(r.first, std::min(t0, t1));
    r.last = std::min(r.last, std::max(t0, t1));
  }
  return r;
}

// `reach` bounds all coordinates of the mesh and of the ray inside it.
MeshRay prepare(const LocalRay& ray, const Range& range, float reach) {
  MeshRay r;
  const Vec3d start = ray.start + range.first * ray.direction;
  const Vec3d direction = (range.last - range.first) * ray.direction;
  // Rounding of the shear and of the slabs, each a few units in the last place of the largest coordinate.
  const float pad = 8.0f * std::numeric_limits<float>::epsilon() * reach;
  for (int a = 0; a < 3; ++a) {
    r.start[a] = static_cast<float>(start[a]);
    r.direction[a] = static_cast<float>(direction[a]);
    r.exact_start[a] = ray.start[a];
    r.exact_direction[a] = ray.direction[a];
    const bool positive = r.direction[a] >= 0.0f;
    const float size = std::max(std::abs(r.direction[a]), 1e-20f);
    r.inverse[a] = positive ? 1.0f / size : -1.0f / size;
    r.near_start[a] = positive ? r.start[a] + pad : r.start[a] - pad;
    r.far_start[a] = positive ? r.start[a] - pad : r.start[a] + pad;
    r.near_row[a] = static_cast<uint32_t>(positive ? a : 3 + a);
    r.far_row[a] = static_cast<uint32_t>(positive ? 3 + a : a);
  }
  r.max_fraction = ray.max_fraction;
  const auto size = [&](int a) { return std::abs(r.direction[a]); };
  r.kz = size(0) > size(1) ? (size(0) > size(2) ? 0 : 2) : (size(1) > size(2) ? 1 : 2);
  r.kx = (r.kz + 1) % 3;
  r.ky = (r.kx + 1) % 3;
  // Keeps the winding whichever way the ray runs.
  if (r.direction[r.kz] < 0.0f) std::swap(r.kx, r.ky);
  r.sx = r.direction[r.kx] / r.direction[r.kz];
  r.sy = r.direction[r.ky] / r.direction[r.kz];
  r.sz = 1.0f / r.direction[r.kz];
  r.front = ray.facet_mode != FacetMode::BackOnly ? 0xffffffffu : 0;
  r.back = ray.facet_mode != FacetMode::FrontOnly ? 0xffffffffu : 0;
  return r;
}

void traceIslands(const LargeMesh& mesh, const MeshRayView& view, const LocalRay& ray, const MeshRay& prepared,
                  double pad, MeshRayHit& hit) {
  for (const MeshIsland& island : mesh.islands) {
    const Range r = insideBox(ray, island.bounds, pad);
    if (r.first > r.last) continue;
    if (isQuantized(mesh.type)) {
      traceRunQuantized(view, prepared, island.first_facet, island.num_facets, hit);
    } else {
      traceRunExpanded(view, prepared, island.first_facet, island.num_facets, hit);
    }
  }
}

bool hasAvx2() {
  static const bool has = __builtin_cpu_supports("avx2");
  return has;
}

void traceHierarchy(const LargeMesh& mesh, const MeshRayView& view, const MeshRay& ray, MeshRayHit& hit) {
  if (isQuantized(mesh.type)) {
    (hasAvx2() ? traceQuantizedAvx2 : traceQuantizedSse2)(view, ray, hit);
  } else {
    (hasAvx2() ? traceExpandedAvx2 : traceExpandedSse2)(view, ray, hit);
  }
}

// Fraction, normal and place in the facet, from the original ray.
ShapeHit describe(const LargeMesh& mesh, const LocalRay& ray, double fraction, uint32_t facet) {
  const auto v = facetVertices(mesh, facet);
  const Vec3d a = v[0].cast<double>(), e1 = v[1].cast<double>() - a, e2 = v[2].cast<double>() - a;
  const Vec3d n = e1.cross(e2);
  const double speed = n.dot(ray.direction);
  if (speed != 0.0) fraction = std::clamp(n.dot(a - ray.start) / speed, 0.0, ray.max_fraction);
  const Vec3d p = ray.start + fraction * ray.direction - a;
  const double nn = n.squaredNorm();
  const double s = std::clamp(p.cross(e2).dot(n) / nn, 0.0, 1.0), t = std::clamp(e1.cross(p).dot(n) / nn, 0.0, 1.0 - s);
  const Vec3d against = speed > 0.0 ? Vec3d(-n) : n;
  return {true, fraction, against.normalized().cast<float>(), facet, Vec2(static_cast<float>(s), static_cast<float>(t))};
}

// The part of the ray that a mesh concerns.
struct Approach {
  Range range = {1.0, 0.0};  // empty: the ray passes by
  double pad = 0.0;          // m
  float reach = 0.0f;        // m
};

Approach approach(const LocalRay& ray, const LargeMesh& mesh) {
  if (ray.direction.isZero(0.0) || mesh.numFacets() == 0) return {};
  const Aabb& box = mesh.surface_bounds;
  const float reach = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
  const double pad = 1e-6 * reach + 1e-30;
  Range range = insideBox(ray, box, pad);
  if (range.first > range.last) return {};
  // Never shorter than the pad, so that a ray that grazes a corner keeps a direction.
  const double least = pad / ray.direction.cwiseAbs().maxCoeff();
  if (range.last - range.first < least) range.first -= least, range.last += least;
  return {range, pad, reach};
}

}  // namespace

MeshRayHit traceWith(MeshRayTrace trace, const LargeMesh& mesh, const LocalRay& ray) {
  MeshRayHit hit;
  const Approach a = approach(ray, mesh);
  if (a.range.first <= a.range.last) trace(viewOf(mesh), prepare(ray, a.range, a.reach), hit);
  return hit;
}

ShapeHit castRay(const LocalRay& ray, const LargeMesh& mesh) {
  const Approach a = approach(ray, mesh);
  if (a.range.first > a.range.last) return {};
  const MeshRayView view = viewOf(mesh);
  const MeshRay prepared = prepare(ray, a.range, a.reach);
  MeshRayHit hit;
  if (hasBvh(mesh.type)) {
    traceHierarchy(mesh, view, prepared, hit);
  } else {
    traceIslands(mesh, view, ray, prepared, a.pad, hit);
  }
  if (hit.facet == kNoFacet) return {};
  return describe(mesh, ray, a.range.first + hit.t * (a.range.last - a.range.first), hit.facet);
}

void castRays(std::span<const LocalRay> rays, const LargeMesh& mesh, std::span<ShapeHit> hits) {
  const size_t n = std::min(rays.size(), hits.size());
  if (!hasBvh(mesh.type)) {
    for (size_t i = 0; i < n; ++i) hits[i] = castRay(rays[i], mesh);
    return;
  }
  const MeshRayView view = viewOf(mesh);
  const auto trace = isQuantized(mesh.type) ? (hasAvx2() ? traceManyQuantizedAvx2 : traceManyQuantizedSse2)
                                            : (hasAvx2() ? traceManyExpandedAvx2 : traceManyExpandedSse2);
  size_t origin[kMaxTogether];
  Range ranges[kMaxTogether];
  MeshRay prepared[kMaxTogether];
  MeshRayHit found[kMaxTogether];
  for (size_t next = 0; next < n;) {
    int count = 0;
    for (; next < n && count < kMaxTogether; ++next) {
      hits[next] = {};
      const Approach a = approach(rays[next], mesh);
      if (a.range.first > a.range.last) continue;
      origin[count] = next;
      ranges[count] = a.range;
      prepared[count] = prepare(rays[next], a.range, a.reach);
      found[count++] = {};
    }
    trace(view, prepared, found, count);
    for (int i = 0; i < count; ++i) {
      if (found[i].facet == kNoFacet) continue;
      const double t = ranges[i].first + found[i].t * (ranges[i].last - ranges[i].first);
      hits[origin[i]] = describe(mesh, rays[origin[i]], t, found[i].facet);
    }
  }
}

}  // namespace pfx
