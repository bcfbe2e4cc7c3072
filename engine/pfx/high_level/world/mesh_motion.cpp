#include "pfx/high_level/world/mesh_motion.h"

#include <algorithm>
#include <stdexcept>

#include "pfx/base_level/shape/mesh_query.h"
#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace pfx {
namespace {

// How far outside of a triangle the projection of p onto its plane lies (m); 0 inside.
float outsideBy(const Vec3& p, const std::array<Vec3, 3>& v, const Vec3& normal) {
  float most = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = v[(k + 1) % 3] - v[k];
    most = std::max(most, -edge.cross(p - v[k]).dot(normal) / edge.norm());
  }
  return most;
}

// Whether p lies over (or below) a triangle. Over an edge where the surface bends, the columns on its triangles leave a
// wedge free that belongs to neither; they are taken to widen by half of their height.
bool liesOver(const Vec3& p, const std::array<Vec3, 3>& v, const Vec3& normal) {
  return outsideBy(p, v, normal) <= 0.5f * std::abs(normal.dot(p - v[0]));
}

Vec3 unitNormal(const std::array<Vec3, 3>& v) { return (v[1] - v[0]).cross(v[2] - v[0]).normalized(); }

// Bodies that wear the mesh. A mesh in a compound has no facets of its own in contacts.
Vector<uint32_t> wearersOf(const World::Impl& w, const LargeMesh* mesh) {
  Vector<uint32_t> out;
  for (uint32_t i = 0; i < w.store.states.size(); ++i) {
    if (!w.store.exists(i)) continue;
    const auto shapes = w.store.collidables[i].shapes();
    const bool wears = std::any_of(shapes.begin(), shapes.end(), [&](const Shape& s) {
      const auto* found = std::get_if<const LargeMesh*>(&s.geometry);
      return found && *found == mesh;
    });
    if (!wears) continue;
    if (shapes.size() != 1 || isDynamic(w.store.states[i].motion_type))
      throw std::invalid_argument("world: body \"" + std::string(w.store.names[i]) + "\" is a compound or dynamic; its mesh is rigid");
    out.push_back(i);
  }
  return out;
}

void refreshWearer(World::Impl& w, uint32_t body) {
  Collidable& c = w.store.collidables[body];
  c.finish();
  w.store.size[body] = c.half_extent.minCoeff();
  w.store.radius[body] = (c.center.cwiseAbs() + c.half_extent).norm();
  w.wakeNeighbours(body);
  w.changed_bodies.push_back(body);
  w.tree_is_current = false;
}

Transform meshPose(const World::Impl& w, uint32_t wearer) {
  return w.store.states[wearer].pose() * w.store.collidables[wearer].shapes()[0].offset;
}

void moveContacts(World::Impl& w, uint32_t wearer, const MeshMotion& motion) {
  const Transform offset = w.store.collidables[wearer].shapes()[0].offset;
  for (const Pair& pair : w.pairs) {
    if (pair.body_a != wearer && pair.body_b != wearer) continue;
    const bool side_a = pair.body_a == wearer;
    const uint32_t other = side_a ? pair.body_b : pair.body_a;
    Contact& contact = w.contacts[pair.contact_id];
    contact.relative.position = Vec3::Constant(1e30f);  // not to be kept as it is
    for (ContactManifold& m : w.contacts.manifolds(pair.contact_id))
      followTriangles(m, motion, w.large_meshes[motion.mesh],
                      {side_a, meshPose(w, wearer), offset, w.store.states[other].pose()});
  }
}

void liftBodies(World::Impl& w, uint32_t wearer, const MeshMotion& motion) {
  const LargeMesh& mesh = w.large_meshes[motion.mesh];
  const Transform pose = meshPose(w, wearer);
  const RigidState& surface = w.store.states[wearer];
  const Aabb swept = shapeAabb(&mesh, pose).grown(motion.farthest);
  Vector<Vec3> vertices;
  Vector<Plane> planes;
  for (uint32_t i = 0; i < w.store.states.size(); ++i) {
    RigidState& s = w.store.states[i];
    const Collidable& c = w.store.collidables[i];
    if (!w.store.exists(i) || !isDynamic(s.motion_type)) continue;
    if (!filtersMatch(surface.filter_self, surface.filter_target, s.filter_self, s.filter_target)) continue;
    if (!transformedAabb(s.pose(), c.center, c.half_extent).overlaps(swept)) continue;
    Vec3 lift = Vec3::Zero();
    for (const Shape& shape : c.shapes()) {
      if (shape.type() == ShapeType::LargeMesh) continue;
      const MeshBody body = makeMeshBody(shape.geometry, relative(pose, s.pose() * shape.offset), {vertices, planes});
      const Vec3 own = liftOf(body, motion, mesh);
      if (own.squaredNorm() > lift.squaredNorm()) lift = own;
    }
    if (lift.isZero(0.0f)) continue;
    w.wake(i);
    w.changed_bodies.push_back(i);
    s.position += pose.orientation * lift;
  }
}

}  // namespace

std::array<uint32_t, 3> facetSources(const LargeMesh& mesh, uint32_t f) {
  std::array<uint32_t, 3> out{};
  for (size_t k = 0; k < 3; ++k)
    out[k] = isQuantized(mesh.type)
                 ? mesh.vertex_source[mesh.vertex_blocks[f / kMaxIslandFacets] + mesh.quantized_facets[f].vertex[k]]
                 : mesh.vertices[mesh.triangles[f][k]].source;
  return out;
}

Vec3 onFacet(std::span<const Vec3> values, const std::array<uint32_t, 3>& i, const Vec2& st) {
  return values[i[0]] + st.x() * (values[i[1]] - values[i[0]]) + st.y() * (values[i[2]] - values[i[0]]);
}

Vector<Vec3> verticesOf(const LargeMesh& mesh, std::span<const Vec3> others) {
  Vector<Vec3> out(others.begin(), others.end());
  for (uint32_t f = 0; f < mesh.numFacets(); ++f) {
    const auto corners = facetVertices(mesh, f);
    const auto sources = facetSources(mesh, f);
    for (size_t k = 0; k < 3; ++k) out[sources[k]] = corners[k];
  }
  return out;
}

void beginMotion(MeshMotion& m, std::span<const Vec3> vertices, float dt) {
  m.before = m.now;
  m.now.assign(vertices.begin(), vertices.end());
  m.velocity.resize(vertices.size());
  m.farthest = 0.0f;
  for (size_t i = 0; i < m.now.size(); ++i) {
    m.farthest = std::max(m.farthest, (m.now[i] - m.before[i]).norm());
    m.velocity[i] = dt > 0.0f ? Vec3((m.now[i] - m.before[i]) / dt) : Vec3(Vec3::Zero());
  }
  m.fastest = dt > 0.0f ? m.farthest / dt : 0.0f;
  m.is_moving = m.fastest > 0.0f;
}

void followTriangles(ContactManifold& manifold, const MeshMotion& motion, const LargeMesh& mesh, const MeshSide& side) {
  if (manifold.num_points == 0) return;
  const MeshTriangle t = meshTriangle(mesh, manifold.points[0].triangle);
  const Vec3 outwards = side.mesh.orientation * t.normal;  // from the mesh
  manifold.normal = side.side_a ? outwards : Vec3(-outwards);
  for (int k = 0; k < manifold.num_points; ++k) {
    ContactPoint& p = manifold.points[static_cast<size_t>(k)];
    const Vec3 place = onFacet(motion.now, facetSources(mesh, p.triangle), p.barycentric);
    (side.side_a ? p.local_a : p.local_b) = side.offset.apply(place);
    const Vec3 other = side.other.apply(side.side_a ? p.local_b : p.local_a);
    p.distance = outwards.dot(other - side.mesh.apply(place));
  }
  const Quat body_a = side.side_a ? Quat(side.mesh.orientation * side.offset.orientation.conjugate()) : side.other.orientation;
  manifold.local_normal = body_a.conjugate() * manifold.normal;
}

Vec3 liftOf(const MeshBody& body, const MeshMotion& motion, const LargeMesh& mesh) {
  float most = 0.0f;
  Vec3 lift = Vec3::Zero();
  visitFacets(mesh, body.bounds.grown(motion.farthest), [&](uint32_t first, uint32_t count) {
    for (uint32_t f = first; f < first + count; ++f) {
      const MeshTriangle now = meshTriangle(mesh, f);
      const float gap = body.lowest(now.normal) - now.normal.dot(now.vertex[0]);
      if (-gap <= most || !liesOver(body.center, now.vertex, now.normal)) continue;
      const auto s = facetSources(mesh, f);
      const std::array<Vec3, 3> before = {motion.before[s[0]], motion.before[s[1]], motion.before[s[2]]};
      const Vec3 normal = unitNormal(before);
      if (normal.dot(body.center - before[0]) < -now.thickness) continue;
      const float deeper = std::min(0.0f, body.lowest(normal) - normal.dot(before[0])) - gap;
      if (deeper <= most) continue;
      most = deeper;
      lift = deeper * now.normal;
    }
  });
  return lift;
}

const MeshMotion* World::Impl::motionOf(uint32_t body) const {
  if (mesh_motions.empty() || store.collidables[body].shapes().size() != 1) return nullptr;
  const auto* mesh = std::get_if<const LargeMesh*>(&store.collidables[body].shapes()[0].geometry);
  if (mesh == nullptr) return nullptr;
  for (const MeshMotion& m : mesh_motions)
    if (m.is_moving && &large_meshes[m.mesh] == *mesh) return &m;
  return nullptr;
}

Vec3 World::Impl::surfaceVelocity(uint32_t body, const ContactManifold& m, const MeshMotion& motion) const {
  const LargeMesh& mesh = large_meshes[motion.mesh];
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < m.num_points; ++k) {
    const ContactPoint& p = m.points[static_cast<size_t>(k)];
    sum += onFacet(motion.velocity, facetSources(mesh, p.triangle), p.barycentric);
  }
  const Quat turn = store.states[body].orientation * store.collidables[body].shapes()[0].offset.orientation;
  return store.states[body].linear_velocity + turn * (sum / static_cast<float>(std::max(m.num_points, 1)));
}

void World::deformMesh(const LargeMesh* mesh, std::span<const Vec3> vertices, float dt) {
  Impl& w = *impl_;
  const MemoryScope scope(w.memory);
  const auto found = std::find_if(w.large_meshes.begin(), w.large_meshes.end(), [&](const auto& m) { return &m == mesh; });
  if (found == w.large_meshes.end()) throw std::invalid_argument("world: the mesh is not kept by the world");
  if (!(dt >= 0.0f && dt < 1e30f)) throw std::invalid_argument("world: dt of a deformation must be >= 0");
  const Vector<uint32_t> wearers = wearersOf(w, mesh);
  const auto index = static_cast<uint32_t>(found - w.large_meshes.begin());
  if (vertices.size() != mesh->num_source_vertices || mesh->numFacets() == 0)
    throw std::invalid_argument("world: a deformation has " + std::to_string(vertices.size()) + " vertices, the mesh " +
                                std::to_string(mesh->num_source_vertices));
  auto motion = std::find_if(w.mesh_motions.begin(), w.mesh_motions.end(), [&](const auto& m) { return m.mesh == index; });
  if (motion == w.mesh_motions.end()) motion = w.mesh_motions.insert(motion, {index, verticesOf(*mesh, vertices)});
  if (const Error e = replaceVertices(*found, vertices); e != Error::Ok)
    throw std::invalid_argument(std::string("world: the vertices of a deformation: ") + toString(e));
  beginMotion(*motion, vertices, dt);
  for (const uint32_t body : wearers) {
    refreshWearer(w, body);
    moveContacts(w, body, *motion);
    liftBodies(w, body, *motion);
  }
  w.active_changed = true;
  ++w.num_deformations;
}

uint64_t World::deformations() const { return impl_->num_deformations; }

namespace stage {

// The mesh stands still unless it is deformed again.
void endMeshMotions(World::Impl& w) {
  for (MeshMotion& m : w.mesh_motions) {
    if (!m.is_moving) continue;
    m.is_moving = false;
    for (uint32_t i = 0; i < w.store.states.size(); ++i) {
      const auto shapes = w.store.collidables[i].shapes();
      const auto* mesh = shapes.empty() ? nullptr : std::get_if<const LargeMesh*>(&shapes[0].geometry);
      if (w.store.exists(i) && mesh && *mesh == &w.large_meshes[m.mesh]) w.changed_bodies.push_back(i);
    }
  }
}

}  // namespace stage
}  // namespace pfx
