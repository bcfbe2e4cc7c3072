// Only the deepest and the outermost contacts are kept while facets stream by, so that their number has no limit.
#include "pfx/base_level/collision/mesh_clusters.h"

#include <utility>

#include "pfx/base_level/collision/contact_reduction.h"

namespace pfx {
namespace {

// Normals within one degree share a manifold.
constexpr float kSameNormal = 0.99985f;

constexpr float kDiagonal = 0.70710678f;
constexpr float kOutward[MeshCluster::kDirections][2] = {{1, 0},  {kDiagonal, kDiagonal},   {0, 1},  {-kDiagonal, kDiagonal},
                                                         {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}};

MeshCluster& clusterOf(std::vector<MeshCluster>& clusters, const Vec3& normal) {
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

int reduceCluster(const MeshCluster& cluster, float size, MeshContact (&out)[kMaxContactPoints]) {
  if (!cluster.primary && !cluster.touching) return 0;
  const MeshContact* origin[1 + MeshCluster::kDirections];
  int n = 0;
  for (int i = 0; i < cluster.count; ++i) {
    const MeshContact& k = cluster.kept[i];
    bool known = false;
    for (int j = 0; j < n; ++j) known |= (origin[j]->point_mesh - k.point_mesh).norm() < 1e-3f * size;
    if (!known) origin[n++] = &k;
  }
  // Outermost first: where areas are equal within the tolerance of the four-point rule, true corners win.
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < n; ++i) mean += origin[i]->point_mesh / static_cast<float>(n);
  const auto spread = [&](const MeshContact* c) { return (c->point_mesh - mean).squaredNorm(); };
  for (int i = 1; i < n; ++i) {
    for (int j = i; j > 0 && spread(origin[j]) > spread(origin[j - 1]); --j) std::swap(origin[j], origin[j - 1]);
  }
  LocalContact candidates[1 + MeshCluster::kDirections];
  for (int i = 0; i < n; ++i) {
    const MeshContact& k = *origin[i];
    candidates[i] = {k.point_mesh, k.point_body, k.distance, static_cast<uint32_t>(i)};
  }
  LocalManifold manifold;
  manifold.normal = cluster.normal;
  reduceContacts(std::span(candidates, static_cast<size_t>(n)), manifold);
  for (int i = 0; i < manifold.num_points; ++i) out[i] = *origin[manifold.points[i].feature];
  return manifold.num_points;
}

}  // namespace pfx
