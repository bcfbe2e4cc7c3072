// A world as solids and overlays, through the engine's debug rendering.
#include "viewer/run/world_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "pfx/util/debug_render/palette.h"
#include "viewer/inspect/mesh_facts.h"

namespace viewer {
namespace {

constexpr Color kVelocityColor = 0xff1f8a4c;
constexpr float kVelocitySeconds = 0.25f;  // s, an arrow shows the way of this time
constexpr float kSlowest = 0.01f;          // m/s, slower bodies get no arrow
constexpr float kAxisLength = 0.6f;        // m
constexpr float kNormalLength = 0.3f;      // m
constexpr float kJointScale = 0.6f;        // m
constexpr float kUnitShare = 0.08f;        // of the distance to what is looked at: a long arrow
constexpr float kWidestAspect = 3.0f;      // of a window, for what the camera may see

}  // namespace

// What never moves would only hide the rest, so bounds, axes and velocities are those of the other bodies.
void WorldView::addBodyOverlays(const OverlayScene& scene) {
  const auto states = scene.world.states();
  for (uint32_t body = 0; body < states.size(); ++body)
    if (states[body].motion_type == pfx::MotionType::Fixed) debug_.setVisible(body, false);
  debug_.scale = kAxisLength;
  if (scene.overlays.aabb) debug_.renderAabb(states, scene.world.collidables());
  if (scene.overlays.axes) debug_.renderLocalAxis(states);
  if (!scene.overlays.velocity) return;
  for (uint32_t body = 0; body < states.size(); ++body)
    if (debug_.getVisible(body) && states[body].linear_velocity.norm() > kSlowest)
      list_.add(Arrow{states[body].position,
                      states[body].position + kVelocitySeconds * states[body].linear_velocity, kVelocityColor,
                      2.0f, pickId(PickKind::Body, body)});
}

void WorldView::addContacts(const OverlayScene& scene) {
  debug_.scale = kNormalLength;
  const auto pairs = scene.world.contactPairs();
  for (uint32_t i = 0; i < pairs.size(); ++i) {
    if (!scene.shows(pairs[i].body_a) && !scene.shows(pairs[i].body_b)) continue;
    recorder_.pick = pickId(PickKind::Contact, i);
    debug_.renderContact(scene.world.states(), pairs[i], scene.world.manifolds(pairs[i]));
  }
}

// Lines along the normals, so many times as long as gaps and overlaps are that the longest can be seen.
void WorldView::addContactDepths(const OverlayScene& scene) {
  float largest = 1e-6f;  // m
  for (const pfx::Pair& pair : scene.world.contactPairs())
    for (const pfx::ContactManifold& m : scene.world.manifolds(pair))
      for (int k = 0; k < m.num_points; ++k) largest = std::max(largest, std::abs(m.points[size_t(k)].distance));
  const float factor = std::max(1.0f, std::pow(10.0f, std::floor(std::log10(scene.unit / largest))));
  const auto pairs = scene.world.contactPairs();
  for (uint32_t i = 0; i < pairs.size(); ++i) {
    recorder_.pick = pickId(PickKind::Contact, i);
    debug_.renderContactDepth(scene.world.states(), pairs[i], scene.world.manifolds(pairs[i]), factor);
  }
  char text[48];
  std::snprintf(text, sizeof text, "overlap, drawn %g times", double(factor));
  list_.add(LegendEntry{pfx::kContactOverlapColor, text});
  list_.add(LegendEntry{pfx::kContactGapColor, "gap"});
}

void WorldView::addIslands(const OverlayScene& scene) {
  recorder_.line_width = 2.5f;
  for (uint32_t i = 0; i < scene.world.numIslands(); ++i) {
    recorder_.pick = pickId(PickKind::Island, i);
    debug_.renderIsland(i, scene.world.island(i).bodies, scene.world.states(), scene.world.collidables());
  }
  recorder_.line_width = 1.5f;
}

void WorldView::addJoints(const OverlayScene& scene) {
  debug_.scale = kJointScale;
  const auto links = scene.world.jointLinks();
  for (uint32_t i = 0; i < links.size(); ++i) {
    if (!links[i].exists || (!scene.shows(links[i].body_a) && !scene.shows(links[i].body_b))) continue;
    recorder_.pick = pickId(PickKind::Joint, i);
    debug_.renderJoint(scene.world.joints()[i], scene.world.states()[links[i].body_a].pose(),
                       scene.world.states()[links[i].body_b].pose());
  }
}

namespace {

// The near plane and the four sides of what a picture of this aspect shows, inside positive: rows of the clip matrix,
// w +- x, w +- y and w + z. Source: G. Gribb, K. Hartmann, Fast Extraction of Viewing Frustum Planes from the
// World-View-Projection Matrix, 2001.
std::array<pfx::FrustumPlane, 5> frustumPlanes(const Camera& camera, float aspect) {
  const Mat4 clip = projectionMatrix(camera, aspect) * viewMatrix(camera);
  std::array<pfx::FrustumPlane, 5> planes;
  for (int i = 0; i < 5; ++i) {
    const float sign = i % 2 == 0 ? 1.0f : -1.0f;
    const Eigen::Matrix<float, 1, 4> row = clip.row(3) + sign * clip.row(i == 4 ? 2 : i / 2);
    const pfx::Vec3 normal(row.x(), row.y(), row.z());
    const float length = normal.norm();
    planes[size_t(i)] = {normal / length, row.w() / length};
  }
  return planes;
}

pfx::MeshDraw meshDraw(const Overlays& o) {
  using pfx::MeshDraw;
  const auto flag = [](bool on, MeshDraw what) { return on ? what : MeshDraw::None; };
  return flag(o.mesh_islands, MeshDraw::Island) | flag(o.mesh_edges || o.mesh_thickness, MeshDraw::Edge) |
         flag(o.mesh_boxes, MeshDraw::FacetAabb) | flag(o.mesh_normals, MeshDraw::Normal) |
         flag(o.mesh_thickness, MeshDraw::Thickness);
}

}  // namespace

// Only islands that the camera may see: a large mesh has more triangles than anybody wants to send.
void WorldView::addMeshes(const OverlayScene& scene) {
  const auto states = scene.world.states();
  const auto collidables = scene.world.collidables();
  debug_.scale = kNormalLength;
  if (!marks_.empty()) debug_.renderLargeMeshByFlag(states, collidables);
  const pfx::MeshDraw what = meshDraw(scene.overlays);
  if (what == pfx::MeshDraw::None) return;
  const auto planes = frustumPlanes(list_.camera, kWidestAspect);
  debug_.renderLargeMeshInFrustum(states, collidables, what, planes);
}

// Drawn through the engine's debug rendering, of visible bodies.
void WorldView::addImmediate(const OverlayScene& scene) {
  const auto states = scene.world.states();
  for (uint32_t body = 0; body < states.size(); ++body)
    debug_.setVisible(body, scene.exists(body) && scene.shows(body));
  if (scene.overlays.contacts) addContacts(scene);
  if (scene.overlays.penetration) addContactDepths(scene);
  if (scene.overlays.joints) addJoints(scene);
  if (scene.overlays.islands) addIslands(scene);
  recorder_.pick = 0;
  addMeshes(scene);
  if (scene.overlays.world) debug_.renderWorld(scene.world.def().center, scene.world.def().extent);
  addBodyOverlays(scene);
}

void WorldView::add(const pfx::World& world, const Overlays& overlays, const ViewExtras& extras) {
  // What a deformed mesh looked like before would only fill memory, so all are announced again in every frame.
  if (world.deformations() > 0) {
    debug_.forgetSolids();
    recorder_.reset();
    recorder_.lifetime = Lifetime::Transient;
  }
  const auto states = world.states();
  debug_.resetVisible(uint32_t(states.size()));
  for (uint32_t body = 0; body < states.size(); ++body)
    debug_.setVisible(body, world.isValid(world.bodyId(body)));
  recorder_.body_colors = overlays.islands ? islandColors(world) : extras.body_colors;
  debug_.renderSolids(states, world.collidables());
  if (overlays == Overlays{} && marks_.empty()) return;

  const bool filtered = overlays.selection_only && !extras.selected.empty();
  const OverlayScene scene{world, overlays, list_, kUnitShare * (list_.camera.target - list_.camera.eye).norm(),
                           filtered ? &extras.selected : nullptr};
  addImmediate(scene);
  if (overlays.inertia) addMasses(scene);
  if (overlays.names) addNames(scene);
  if (overlays.trails && extras.trails) addTrails(scene, *extras.trails);
  addContactOverlays(scene);
  addJointOverlays(scene);
  if (overlays.sleep || overlays.solver) addIslandLabels(scene);
  addParticleOverlays(scene);
  if (overlays.tree) addPairSearch(scene);
  if (overlays.probe && extras.probe) addProbe(scene, *extras.probe);
}

void WorldView::addTriangle(const pfx::World& world, uint32_t body, uint32_t facet, Color color) {
  const auto placed = meshOfBody(world, body);
  if (!placed || facet >= placed->mesh->numFacets()) return;
  const pfx::MeshTriangle t = pfx::meshTriangle(*placed->mesh, facet);
  std::array<pfx::Vec3, 3> corners;
  const pfx::Vec3 normal = placed->pose.orientation * t.normal;
  const float size = std::sqrt((t.vertex[1] - t.vertex[0]).cross(t.vertex[2] - t.vertex[0]).norm());
  for (size_t k = 0; k < 3; ++k) corners[k] = placed->pose.apply(t.vertex[k]) + 0.004f * size * normal;
  for (size_t k = 0; k < 3; ++k) list_.add(Line{corners[k], corners[(k + 1) % 3], color, 3.0f});
  const pfx::Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0f;
  list_.add(Arrow{middle, middle + 0.35f * size * normal, color, 2.5f});
  const uint64_t key = 0x7472690000000000u ^ uint64_t(body) << 32 ^ facet;
  const std::array<uint32_t, 3> order = {0, 1, 2};
  list_.defineTransientMesh(key, [&] { return makeMesh(t.vertex, order); });
  const Color tint = (color & 0x00ffffffu) | 0x66000000u;
  list_.add(key, {.position = placed->pose.position + 0.003f * size * normal,
                  .orientation = placed->pose.orientation,
                  .color = tint,
                  .finish = uint32_t(pfx::Finish::Translucent),
                  .pick = pickId(PickKind::Body, body)});
}

void WorldView::mark(const pfx::World& world, const pfx::MeshTriangleId& triangle, pfx::MeshDraw what) {
  if (triangle.body >= world.collidables().size()) return;
  if (debug_.setLargeMeshFlag(triangle, world.collidables()[triangle.body], what) != pfx::Error::Ok) return;
  if (what == pfx::MeshDraw::None)
    marks_.erase(triangle);
  else
    marks_[triangle] = what;
}

pfx::MeshDraw WorldView::markOf(const pfx::MeshTriangleId& triangle) const {
  const auto found = marks_.find(triangle);
  return found == marks_.end() ? pfx::MeshDraw::None : found->second;
}

}  // namespace viewer
