#include "pfx/low_level/collision/seams.h"

#include <algorithm>

namespace pfx {
namespace {

// `group` holds all mesh pairs of one body.
void cleanPair(const SeamInput& in, std::span<const MeshPair> group, const MeshPair& at,
               ContactStore& contacts) {
  const Pair& pair = in.pairs[at.pair];
  const bool mesh_is_a = pair.body_a == at.mesh_body;
  const Transform mesh_pose = in.states[at.mesh_body].pose();
  const auto manifolds = contacts.manifolds(pair.contact_id);
  for (ContactManifold& m : manifolds) {
    const Vec3 normal = mesh_is_a ? m.normal : Vec3(-m.normal);
    const auto isGhost = [&](const ContactPoint& p) {
      const SurfacePoint point{mesh_pose.apply(mesh_is_a ? p.local_a : p.local_b), normal};
      SeamVerdict verdict;
      for (const MeshPair& g : group)
        judge(in.collidables[g.mesh_body], in.states[g.mesh_body].pose(), point, verdict);
      return verdict.isGhost();
    };
    const auto begin = m.points.begin();
    m.num_points = static_cast<int>(std::remove_if(begin, begin + m.num_points, isGhost) - begin);
  }
  const auto is_empty = [](const ContactManifold& m) { return m.num_points == 0; };
  const auto end = std::remove_if(manifolds.begin(), manifolds.end(), is_empty);
  contacts.shorten(pair.contact_id, static_cast<uint16_t>(end - manifolds.begin()));
}

bool hasSeveralMeshes(const SeamInput& in, std::span<const MeshPair> group) {
  return group.size() > 1 || in.collidables[group[0].mesh_body].shapes().size() > 1;
}

}  // namespace

std::span<const MeshPair> meshPairsOf(std::span<const MeshPair> sorted, uint32_t body) {
  const auto range = std::ranges::equal_range(sorted, body, {}, &MeshPair::body);
  return {range.begin(), range.end()};
}

void judge(const Collidable& collidable, const Transform& pose, const SurfacePoint& at,
           SeamVerdict& verdict) {
  for (const Shape& shape : collidable.shapes()) {
    const auto* mesh = std::get_if<const LargeMesh*>(&shape.geometry);
    if (mesh == nullptr) continue;
    const Transform to_world = pose * shape.offset;
    judge(**mesh, {to_world.applyInverse(at.point), to_world.orientation.conjugate() * at.normal, at.slack},
          verdict);
  }
}

void dropGhostContacts(const SeamInput& input, Vector<MeshPair>& found, ContactStore& contacts) {
  std::sort(found.begin(), found.end());
  if (std::ranges::none_of(found, &MeshPair::leans)) return;
  for (std::span<const MeshPair> rest = found; !rest.empty();) {
    const auto group = meshPairsOf(rest, rest[0].body);
    if (hasSeveralMeshes(input, group))
      for (const MeshPair& p : group)
        if (p.leans) cleanPair(input, group, p, contacts);
    rest = rest.subspan(group.size());
  }
}

}  // namespace pfx
