// What the application says about contacts: pairs that it keeps apart, and manifolds that it changes.
#include <algorithm>

#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx::stage {
namespace {

// Squared distance of a point to the plane of a facet (m^2), in the frame of the mesh.
float planeDistance2(const LargeMesh& mesh, uint32_t facet, const Vec3& point) {
  const auto v = facetVertices(mesh, facet);
  const Vec3 n = (v[1] - v[0]).cross(v[2] - v[0]);
  const float d = n.dot(point - v[0]);
  return d * d / std::max(n.squaredNorm(), 1e-30f);
}

// User data of the facet that a contact point lies on: of the mesh, when a body has several, whose facet of that number
// is nearest.
uint32_t userDataAt(const Collidable& collidable, uint32_t facet, const Vec3& local_point) {
  uint32_t found = 0;
  float nearest = 1e30f;
  for (const Shape& s : collidable.shapes()) {
    const auto* const* mesh = std::get_if<const LargeMesh*>(&s.geometry);
    if (mesh == nullptr || facet >= (*mesh)->numFacets()) continue;
    const float distance = planeDistance2(**mesh, facet, s.offset.applyInverse(local_point));
    if (distance >= nearest) continue;
    nearest = distance;
    found = userData(**mesh, facet);
  }
  return found;
}

ContactModification modificationOf(const World::Impl& w, const ContactConstraint& c) {
  const auto id = [&](uint32_t body) { return BodyId{body, w.store.generations[body]}; };
  ContactModification m{.body_a = id(c.solver_a),
                        .body_b = id(c.solver_b),
                        .manifold = *c.manifold,
                        .user_data = {},
                        .friction = c.friction,
                        .restitution = c.restitution,
                        .rolling_resistance = c.rolling_resistance,
                        .torsional_resistance = c.torsional_resistance};
  const auto has_mesh = [&](uint32_t body) {
    return std::ranges::any_of(w.store.collidables[body].shapes(),
                               [](const Shape& s) { return s.type() == ShapeType::LargeMesh; });
  };
  const bool mesh_a = has_mesh(c.solver_a), mesh_b = !mesh_a && has_mesh(c.solver_b);
  for (int i = 0; (mesh_a || mesh_b) && i < m.manifold.num_points; ++i) {
    const ContactPoint& p = m.manifold.points[i];
    m.user_data[static_cast<size_t>(i)] = userDataAt(w.store.collidables[mesh_a ? c.solver_a : c.solver_b], p.triangle,
                                                     mesh_a ? p.local_a : p.local_b);
  }
  return m;
}

bool isSound(const ContactModification& m) {
  return m.manifold.num_points > 0 && m.manifold.num_points <= kMaxContactPoints && m.manifold.normal.allFinite() &&
         m.friction >= 0.0f && m.restitution >= 0.0f && m.rolling_resistance >= 0.0f && m.torsional_resistance >= 0.0f;
}

}  // namespace

void modifyContacts(World::Impl& w) {
  w.modified.clear();
  if (!w.contact_modifier) return;
  w.modified.reserve(w.constraints.size());  // the solver keeps pointers into it
  std::erase_if(w.constraints, [&](ContactConstraint& c) {
    ContactModification m = modificationOf(w, c);
    if (!w.contact_modifier(m) || !isSound(m)) return true;
    c.friction = m.friction;
    c.restitution = m.restitution;
    c.rolling_resistance = m.rolling_resistance;
    c.torsional_resistance = m.torsional_resistance;
    w.modified.push_back({m.manifold, c.manifold});
    c.manifold = &w.modified.back().manifold;
    return false;
  });
}

void keepModifiedImpulses(World::Impl& w) {
  for (const ModifiedContact& m : w.modified) {
    for (int i = 0; i < m.manifold.num_points; ++i) {
      const ContactPoint& from = m.manifold.points[i];
      for (int k = 0; k < m.original->num_points; ++k) {
        ContactPoint& to = m.original->points[k];
        if (to.feature != from.feature) continue;
        to.normal_impulse = from.normal_impulse;
        to.friction_impulse = from.friction_impulse;
      }
    }
  }
}

void dropApart(World::Impl& w, Vector<Pair>& pairs) {
  for (std::span<const uint64_t> apart : {w.joint_store.keptApart(), w.apart.keys()}) {
    if (apart.empty()) continue;
    std::erase_if(pairs, [&](const Pair& p) {
      while (!apart.empty() && apart.front() < p.key()) apart = apart.subspan(1);
      return !apart.empty() && apart.front() == p.key();
    });
  }
  if (!w.pair_filter) return;
  const auto id = [&](uint32_t body) { return BodyId{body, w.store.generations[body]}; };
  std::erase_if(pairs, [&](const Pair& p) { return !w.pair_filter(id(p.body_a), id(p.body_b)); });
}

}  // namespace pfx::stage
