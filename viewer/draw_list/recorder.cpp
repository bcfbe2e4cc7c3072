#include "viewer/draw_list/recorder.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"

namespace viewer {

namespace {

using pfx::Vec3;

Recorder& self(void* context) { return *static_cast<Recorder*>(context); }

// A rotation by `angle` (rad) of `direction` about `axis`, which is a unit vector across it.
Vec3 turned(const Vec3& direction, const Vec3& axis, double angle) {
  return float(std::cos(angle)) * direction + float(std::sin(angle)) * axis.cross(direction);
}

MeshData triangulate(const pfx::ConvexMesh& mesh) {
  std::vector<uint32_t> indices;
  for (const pfx::PolytopeFace& face : mesh.faces)
    for (uint32_t k = 2; k < face.count; ++k) {
      const uint16_t* corner = &mesh.face_vertices[face.first];
      indices.insert(indices.end(), {corner[0], corner[k - 1], corner[k]});
    }
  return makeMesh(mesh.vertices, indices);
}

MeshData triangulate(const pfx::LargeMesh& mesh) {
  std::vector<Vec3> points;
  std::vector<uint32_t> indices;
  for (uint32_t facet = 0; facet < mesh.numFacets(); ++facet)
    for (const Vec3& corner : pfx::facetVertices(mesh, facet)) {
      indices.push_back(uint32_t(points.size()));
      points.push_back(corner);
    }
  MeshData front = makeMesh(points, indices);
  // One that has an edge of its own can be seen from behind.
  const bool is_open = std::any_of(
      mesh.neighbors.begin(), mesh.neighbors.end(),
      [](const pfx::MeshIndices& n) { return std::find(n.begin(), n.end(), pfx::kNoFacet) != n.end(); });
  if (!is_open) return front;
  for (size_t i = 0; i + 3 <= indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
  front.append(makeMesh(points, indices));
  return front;
}

}  // namespace

void addBox(DrawList& list, const pfx::Transform& pose, const Vec3& half_extent, const Line& style) {
  const auto corner = [&](int i) {
    return pose.apply(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(half_extent));
  };
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4})
      if (!(i & bit)) list.add(Line{corner(i), corner(i | bit), style.color, style.width, style.pick});
}

void addArc(DrawList& list, const Arc& arc, const Line& style) {
  constexpr double kStep = 0.1309;  // rad, 7.5 degrees
  const double sweep = double(arc.end) - arc.start;
  if (!std::isfinite(sweep)) return;
  const int n = int(std::clamp(std::ceil(std::abs(sweep) / kStep), 1.0, 480.0));
  Vec3 last = arc.center + arc.radius * turned(arc.direction, arc.axis, arc.start);
  for (int i = 1; i <= n; ++i) {
    const Vec3 next = arc.center + arc.radius * turned(arc.direction, arc.axis, arc.start + sweep * i / n);
    list.add(Line{last, next, style.color, style.width, style.pick});
    last = next;
  }
}

pfx::DebugRenderCallbacks Recorder::callbacks() {
  pfx::DebugRenderCallbacks c;
  c.context = this;
  c.point = [](void* r, const Vec3& p, pfx::Color color) {
    self(r).list_->add(Point{p, color, self(r).point_size, self(r).pick});
  };
  c.line = [](void* r, const Vec3& from, const Vec3& to, pfx::Color color) {
    self(r).list_->add(Line{from, to, color, self(r).line_width, self(r).pick});
  };
  c.arc = [](void* r, const Vec3& center, const Vec3& axis, const Vec3& direction, float radius, float start,
             float end, pfx::Color color) {
    addArc(*self(r).list_, {center, axis, direction, radius, start, end}, self(r).style(color));
  };
  c.aabb = [](void* r, const Vec3& center, const Vec3& half_extent, pfx::Color color) {
    addBox(*self(r).list_, {center, pfx::Quat::Identity()}, half_extent, self(r).style(color));
  };
  c.box = [](void* r, const pfx::Transform& pose, const Vec3& half_extent, pfx::Color color) {
    addBox(*self(r).list_, pose, half_extent, self(r).style(color));
  };
  c.define_solid = [](void* r, uint64_t key, const pfx::Geometry& geometry) {
    self(r).placements_[key] = placementOf(key, geometry, *self(r).list_, self(r).lifetime);
  };
  c.draw_solids = [](void* r, uint64_t key, std::span<const pfx::SolidInstance> instances) {
    self(r).draw(key, instances);
  };
  return c;
}

Placement placementOf(uint64_t key, const pfx::Geometry& geometry, DrawList& list, Lifetime lifetime) {
  if (const auto* s = std::get_if<pfx::Sphere>(&geometry)) return {kRound, Vec3(0.0f, s->radius, s->radius)};
  if (const auto* c = std::get_if<pfx::Capsule>(&geometry))
    return {kRound, Vec3(c->half_length, c->radius, c->radius)};
  if (const auto* b = std::get_if<pfx::Box>(&geometry)) return {kUnitBox, b->half_extent};
  if (const auto* y = std::get_if<pfx::Cylinder>(&geometry))
    return {kUnitCylinder, Vec3(y->half_length, y->radius, y->radius)};
  const auto define = [&](const auto& mesh) {
    if (lifetime == Lifetime::Transient)
      list.defineTransientMesh(key, [&] { return triangulate(mesh); });
    else if (!list.hasMesh(key))
      list.defineMesh(key, triangulate(mesh));
  };
  if (const auto* convex = std::get_if<const pfx::ConvexMesh*>(&geometry); convex && *convex) define(**convex);
  if (const auto* mesh = std::get_if<const pfx::LargeMesh*>(&geometry); mesh && *mesh) define(**mesh);
  return {key, Vec3::Ones()};
}

void Recorder::draw(uint64_t key, std::span<const pfx::SolidInstance> instances) {
  const auto found = placements_.find(key);
  if (found == placements_.end()) return;
  const Placement place = found->second;
  list_->append(place.mesh, instances.size(), [&](size_t i) {
    const pfx::SolidInstance& s = instances[i];
    const Color own = s.body < body_colors.size() ? body_colors[s.body] : 0;
    return Instance{s.pose.position, s.pose.orientation, place.scale, own ? own : s.color, uint32_t(s.finish),
                    pickId(PickKind::Body, s.body)};
  });
}

}  // namespace viewer
