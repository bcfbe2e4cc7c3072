// Facets near the body, one after the other, then a manifold for each cluster of normals.
#include "pfx/base_level/collision/mesh_contact.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/mesh_body.h"
#include "pfx/base_level/collision/mesh_clusters.h"
#include "pfx/base_level/collision/mesh_facet.h"
#include "pfx/base_level/math/finite.h"
#include "pfx/base_level/shape/collidable.h"
#include "pfx/base_level/shape/mesh_query.h"

namespace pfx {
namespace {

// (s, t) of a point in its facet, kept inside.
Vec2 barycentric(const LargeMesh& mesh, uint32_t facet, const Vec3& point) {
  const auto v = facetVertices(mesh, facet);
  const Vec3 e1 = v[1] - v[0], e2 = v[2] - v[0], p = point - v[0], n = e1.cross(e2);
  const float nn = n.squaredNorm();
  if (!(nn > 0.0f)) return Vec2::Zero();
  const float s = std::clamp(p.cross(e2).dot(n) / nn, 0.0f, 1.0f);
  return {s, std::clamp(e1.cross(p).dot(n) / nn, 0.0f, 1.0f - s)};
}

// The same vertex may touch a floor and a wall: the rough direction of the normal tells them apart.
uint32_t normalName(const Vec3& n) {
  const auto third = [](float x) { return static_cast<uint32_t>(std::lround(x * 2.0f) + 2); };
  return (third(n.x()) * 25 + third(n.y()) * 5 + third(n.z())) << 24;
}

// How the points of a pair get from the frame of the mesh to where the manifold wants them.
struct PairFrames {
  const CollideInput& in;
  bool mesh_is_a;
  const Transform& meshOffset() const { return mesh_is_a ? in.shape_a.offset : in.shape_b.offset; }
  const Transform& meshBody() const { return mesh_is_a ? in.body_a : in.body_b; }
  const Transform& otherOffset() const { return mesh_is_a ? in.shape_b.offset : in.shape_a.offset; }
  const Transform& otherBody() const { return mesh_is_a ? in.body_b : in.body_a; }
};

void writeManifold(const PairFrames& frames, const LargeMesh& mesh, const MeshCluster& cluster,
                   std::span<const MeshContact> contacts, Vector<ContactManifold>& out) {
  ContactManifold& m = out.emplace_back();
  const Transform& offset = frames.meshOffset();
  const Transform to_other = relative(frames.otherBody(), frames.meshBody());
  const Vec3 in_mesh_body = offset.orientation * cluster.normal;
  const Vec3 world = frames.meshBody().orientation * in_mesh_body;
  m.normal = frames.mesh_is_a ? world : Vec3(-world);
  m.local_normal = frames.mesh_is_a ? in_mesh_body : Vec3(-(to_other.orientation * in_mesh_body));
  for (const MeshContact& c : contacts) {
    ContactPoint& p = m.points[m.num_points++];
    const Vec3 on_mesh = offset.apply(c.point_mesh), on_body = to_other.apply(offset.apply(c.point_body));
    p.local_a = frames.mesh_is_a ? on_mesh : on_body;
    p.local_b = frames.mesh_is_a ? on_body : on_mesh;
    p.distance = c.distance;
    p.feature = c.feature ^ normalName(cluster.normal);
    p.triangle = c.facet;
    p.barycentric = barycentric(mesh, c.facet, c.point_mesh);
  }
}

}  // namespace

int collideMesh(const CollideInput& input, MeshContactScratch& scratch, Vector<ContactManifold>& manifolds) {
  const bool mesh_is_a = input.shape_a.type() == ShapeType::LargeMesh;
  if (mesh_is_a == (input.shape_b.type() == ShapeType::LargeMesh)) return 0;
  if (isMissing(input.shape_a.geometry) || isMissing(input.shape_b.geometry)) return 0;
  if (!isFinite(relative(input.body_a, input.body_b))) return 0;
  const PairFrames frames{input, mesh_is_a};
  const LargeMesh& mesh = *std::get<const LargeMesh*>((mesh_is_a ? input.shape_a : input.shape_b).geometry);
  const Geometry& geometry = (mesh_is_a ? input.shape_b : input.shape_a).geometry;
  const Transform other = relative(frames.meshBody(), frames.otherBody()) * frames.otherOffset();
  const MeshBody body =
      makeMeshBody(geometry, relative(frames.meshOffset(), other), {scratch.vertices, scratch.planes});

  scratch.clusters.clear();
  const FacetContext context{mesh, body, input.margin, scratch.clusters};
  scratch.facets.clear();
  visitFacets(mesh, body.bounds.grown(input.margin + mesh.max_thickness), [&](uint32_t first, uint32_t count) {
    for (uint32_t f = first; f < first + count; ++f) scratch.facets.push_back(f);
  });
  // A mesh that was written and built anew may have its facets in another order; its contacts are the same.
  std::ranges::sort(scratch.facets, {}, [&](uint32_t f) { return mesh.source[f]; });
  for (uint32_t f : scratch.facets) collideFacet(context, f);

  const size_t before = manifolds.size();
  for (const MeshCluster& cluster : scratch.clusters) {
    MeshContact contacts[kMaxContactPoints];
    const int n = reduceCluster(cluster, body.size, contacts);
    if (n > 0) writeManifold(frames, mesh, cluster, std::span(contacts, static_cast<size_t>(n)), manifolds);
  }
  return static_cast<int>(manifolds.size() - before);
}

}  // namespace pfx
