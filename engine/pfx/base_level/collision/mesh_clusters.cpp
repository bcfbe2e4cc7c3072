// Only the deepest and the outermost contacts are kept while facets stream by, so that their number has no limit.
#include "pfx/base_level/collision/mesh_clusters.h"

#include "pfx/base_level/collision/contact_reduction.h"

namespace pfx {
namespace {

// Normals within one degree share a manifold.
constexpr float kSameNormal = 0.99985f;

constexpr float kDiagonal = 0.70710678f;
constexpr float kOutward[MeshCluster::kDirections][2] = {{1, 0},  {kDiagonal, kDiagonal},   {0, 1},  {-kDiagonal, kDiagonal},
                                                         {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}};

MeshCluster& clusterOf(Vector<MeshCluster>& clusters, const Vec3& normal) {
  for (MeshCluster& c : clusters) {
    if (c.normal.dot(normal) > kSameNormal) return c;
  }
  MeshCluster& c = clusters.emplace_back();
  c.normal = normal;
  return c;
}

}  // namespace

void addContact(const FacetContext& context, const Vec3& normal, bool primary, const MeshContact& contact) {
  if (contact.distance > context.margin) return;
  MeshCluster& c = clusterOf(context.clusters, normal);
  c.primary |= primary;
  c.touching |= contact.distance <= 0.0f;
  if (c.count == 0 || contact.distance < c.kept[0].distance) c.kept[0] = contact;
  const TangentPair t = tangents(c.normal);
  const Vec3 p = contact.point_mesh - context.body.center;
  const float x = p.dot(t.t1), y = p.dot(t.t2);
  for (int d = 0; d < MeshCluster::kDirections; ++d) {
    const float reach = x * kOutward[d][0] + y * kOutward[d][1];
    if (c.count != 0 && reach <= c.reach[d]) continue;
    c.reach[d] = reach;
    c.kept[1 + d] = contact;
  }
  c.count = 1 + MeshCluster::kDirections;
}

namespace {

// The kept contacts that the hull of a cluster needs, outermost first, so that true corners come before points on the
// edges between them, and names stay the same while a body slides.
struct Outline {
  const MeshContact* points[1 + MeshCluster::kDirections];
  int count = 0;
};

Outline outlineOf(const MeshCluster& cluster, float size) {
  const TangentPair t = tangents(cluster.normal);
  const auto reach = [&](const MeshContact& c, int d) {
    return c.point_mesh.dot(t.t1) * kOutward[d][0] + c.point_mesh.dot(t.t2) * kOutward[d][1];
  };
  Vec3 mean = Vec3::Zero();
  for (int d = 0; d < MeshCluster::kDirections; ++d) mean += cluster.kept[1 + d].point_mesh;
  mean /= static_cast<float>(MeshCluster::kDirections);
  const auto spread = [&](int d) { return (cluster.kept[1 + d].point_mesh - mean).squaredNorm(); };

  int order[MeshCluster::kDirections];
  for (int d = 0; d < MeshCluster::kDirections; ++d) {
    int place = d;
    for (; place > 0 && spread(d) > spread(order[place - 1]); --place) order[place] = order[place - 1];
    order[place] = d;
  }
  Outline outline;
  const float tolerance = 1e-3f * size;
  for (const int d : order) {
    const MeshContact& c = cluster.kept[1 + d];
    bool covered = false;
    for (int i = 0; i < outline.count; ++i) covered |= reach(*outline.points[i], d) >= reach(c, d) - tolerance;
    if (!covered) outline.points[outline.count++] = &c;
  }
  // The deepest is kept in any case, unless the outline is as deep to within rounding.
  const MeshContact& deepest = cluster.kept[0];
  bool as_deep = false;
  for (int i = 0; i < outline.count; ++i) as_deep |= outline.points[i]->distance <= deepest.distance + 0.1f * tolerance;
  if (!as_deep) outline.points[outline.count++] = &deepest;
  return outline;
}

}  // namespace

int reduceCluster(const MeshCluster& cluster, float size, MeshContact (&out)[kMaxContactPoints]) {
  if (!cluster.primary && !cluster.touching) return 0;
  const Outline outline = outlineOf(cluster, size);
  LocalContact candidates[1 + MeshCluster::kDirections];
  for (int i = 0; i < outline.count; ++i) {
    const MeshContact& c = *outline.points[i];
    candidates[i] = {c.point_mesh, c.point_body, c.distance, static_cast<uint32_t>(i)};
  }
  LocalManifold manifold;
  manifold.normal = cluster.normal;
  reduceContacts(std::span(candidates, static_cast<size_t>(outline.count)), manifold);
  for (int i = 0; i < manifold.num_points; ++i) out[i] = *outline.points[manifold.points[i].feature];
  return manifold.num_points;
}

}  // namespace pfx
