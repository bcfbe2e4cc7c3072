// Debug drawing of large meshes: islands, edges, normals, thickness, boxes.
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/util/debug_render/debug_render.h"
#include "pfx/util/debug_render/palette.h"

namespace pfx {

struct DebugRender::MeshView {
  const LargeMesh& mesh;
  Transform pose;  // mesh frame to world
};

namespace {

const LargeMesh* meshOf(const Shape& shape) {
  const auto* mesh = std::get_if<const LargeMesh*>(&shape.geometry);
  return mesh != nullptr ? *mesh : nullptr;
}

// The shape of a body that has its first large mesh; null when there is none.
const Shape* meshShape(const Collidable& collidable) {
  for (const Shape& shape : collidable.shapes()) {
    if (meshOf(shape) != nullptr) return &shape;
  }
  return nullptr;
}

}  // namespace

void DebugRender::renderMeshIsland(const MeshView& view, uint32_t island) {
  if (callbacks.box == nullptr) return;
  const Aabb& box = view.mesh.islands[island].bounds;
  const Transform pose = view.pose * Transform{box.center(), Quat::Identity()};
  callbacks.box(callbacks.context, pose, box.halfExtent(), indexColor(island));
}

void DebugRender::renderTriangle(const MeshView& view, uint32_t facet, MeshDraw what) {
  const MeshTriangle triangle = meshTriangle(view.mesh, facet);
  if (has(what, MeshDraw::FacetAabb) && callbacks.box != nullptr) {
    Aabb box;
    for (const Vec3& v : triangle.vertex) box.extend(v);
    const Transform pose = view.pose * Transform{box.center(), Quat::Identity()};
    callbacks.box(callbacks.context, pose, box.halfExtent(), kFacetBoxColor);
  }
  if (callbacks.line == nullptr) return;
  const auto line = [&](const Vec3& from, const Vec3& to, Color color) {
    callbacks.line(callbacks.context, view.pose.apply(from), view.pose.apply(to), color);
  };
  const auto& v = triangle.vertex;
  if (has(what, MeshDraw::Normal)) {
    const Vec3 middle = (v[0] + v[1] + v[2]) / 3.0f;
    line(middle, middle + scale * triangle.normal, kNormalColor);
  }
  if (!has(what, MeshDraw::Edge)) return;
  const Vec3 down = -triangle.thickness * triangle.normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    line(v[k], v[next], kEdgeColors[static_cast<std::size_t>(triangle.kind[k])]);
    if (!has(what, MeshDraw::Thickness)) continue;
    line(v[k] + down, v[next] + down, kThicknessColor);
    line(v[k], v[k] + down, kThicknessColor);
  }
}

// Draws the islands for which inside(centre, radius of the bounding sphere in the world) is true.
template <class Inside>
void DebugRender::renderIslands(std::span<const RigidState> states, std::span<const Collidable> collidables,
                                MeshDraw what, Inside&& inside) {
  constexpr MeshDraw kOfTriangles = MeshDraw::Edge | MeshDraw::FacetAabb | MeshDraw::Normal;
  for (uint32_t body = 0; body < states.size(); ++body) {
    if (!getVisible(body)) continue;
    for (const Shape& shape : collidables[body].shapes()) {
      const LargeMesh* mesh = meshOf(shape);
      if (mesh == nullptr) continue;
      const MeshView view{*mesh, states[body].pose() * shape.offset};
      for (uint32_t i = 0; i < mesh->islands.size(); ++i) {
        const MeshIsland& island = mesh->islands[i];
        if (!inside(view.pose.apply(island.bounds.center()), island.bounds.halfExtent().norm())) continue;
        if (has(what, MeshDraw::Island)) renderMeshIsland(view, i);
        if (!has(what, kOfTriangles)) continue;
        for (uint32_t t = 0; t < island.num_facets; ++t) renderTriangle(view, island.first_facet + t, what);
      }
    }
  }
}

void DebugRender::renderLargeMesh(std::span<const RigidState> states, std::span<const Collidable> collidables,
                                  MeshDraw what) {
  renderIslands(states, collidables, what, [](const Vec3&, float) { return true; });
}

void DebugRender::renderLargeMeshInFrustum(std::span<const RigidState> states,
                                           std::span<const Collidable> collidables, MeshDraw what,
                                           std::span<const FrustumPlane> planes) {
  renderIslands(states, collidables, what, [&](const Vec3& center, float radius) {
    for (const FrustumPlane& plane : planes) {
      if (plane.normal.dot(center) + plane.offset < -radius) return false;
    }
    return true;
  });
}

void DebugRender::renderLargeMeshInSphere(std::span<const RigidState> states,
                                          std::span<const Collidable> collidables, MeshDraw what,
                                          const Vec3& center, float radius) {
  renderIslands(states, collidables, what, [&](const Vec3& island_center, float island_radius) {
    const float reach = radius + island_radius;
    return (island_center - center).squaredNorm() <= reach * reach;
  });
}

Error DebugRender::setLargeMeshFlag(const MeshTriangleId& triangle, const Collidable& collidable,
                                    MeshDraw what) {
  const Shape* shape = meshShape(collidable);
  if (shape == nullptr) return Error::NullPointer;
  const LargeMesh& mesh = *meshOf(*shape);
  if (triangle.island >= mesh.islands.size()) return Error::OutOfRange;
  if (triangle.triangle >= mesh.islands[triangle.island].num_facets) return Error::OutOfRange;
  setLargeMeshFlag(triangle, what);
  return Error::Ok;
}

void DebugRender::setLargeMeshFlag(const MeshTriangleId& triangle, MeshDraw what) {
  if (what == MeshDraw::None) {
    mesh_flags_.erase(triangle);
  } else {
    mesh_flags_[triangle] = what;
  }
}

void DebugRender::renderLargeMeshByFlag(std::span<const RigidState> states,
                                        std::span<const Collidable> collidables) {
  const MeshTriangleId* last_island = nullptr;  // whose box was drawn
  for (const auto& [id, what] : mesh_flags_) {
    if (id.body >= states.size() || !getVisible(id.body)) continue;
    const Shape* shape = meshShape(collidables[id.body]);
    if (shape == nullptr) continue;
    const MeshView view{*meshOf(*shape), states[id.body].pose() * shape->offset};
    // The mesh may have been exchanged since the triangle was marked.
    if (id.island >= view.mesh.islands.size() || id.triangle >= view.mesh.islands[id.island].num_facets)
      continue;
    const bool is_new =
        last_island == nullptr || last_island->body != id.body || last_island->island != id.island;
    if (has(what, MeshDraw::Island) && is_new) {
      renderMeshIsland(view, id.island);
      last_island = &id;
    }
    renderTriangle(view, view.mesh.islands[id.island].first_facet + id.triangle, what);
  }
}

}  // namespace pfx
