// A world as solids and overlays, through the engine's debug rendering.
#include "viewer/run/world_view.h"

#include <array>
#include <cmath>

#include "viewer/inspect/mesh_facts.h"

namespace viewer {
namespace {

constexpr Color kVelocityColor = 0xff1f8a4c;
constexpr float kVelocitySeconds = 0.25f;  // s, an arrow shows the way of this time
constexpr float kSlowest = 0.01f;          // m/s, slower bodies get no arrow
constexpr float kAxisLength = 0.6f;        // m
constexpr float kNormalLength = 0.3f;      // m
constexpr float kJointScale = 0.6f;        // m

}  // namespace

// What never moves would only hide the rest, so bounds, axes and velocities are those of the other bodies.
void WorldView::addBodyOverlays(const pfx::World& world, const Overlays& overlays) {
  const auto states = world.states();
  for (uint32_t body = 0; body < states.size(); ++body)
    debug_.setVisible(
        body, world.isValid(world.bodyId(body)) && states[body].motion_type != pfx::MotionType::Fixed);
  debug_.scale = kAxisLength;
  if (overlays.aabb) debug_.renderAabb(states, world.collidables());
  if (overlays.axes) debug_.renderLocalAxis(states);
  if (!overlays.velocity) return;
  for (uint32_t body = 0; body < states.size(); ++body)
    if (debug_.getVisible(body) && states[body].linear_velocity.norm() > kSlowest)
      list_.add(Arrow{states[body].position,
                      states[body].position + kVelocitySeconds * states[body].linear_velocity, kVelocityColor,
                      2.0f, pickId(PickKind::Body, body)});
}

void WorldView::addContacts(const pfx::World& world) {
  debug_.scale = kNormalLength;
  const auto pairs = world.contactPairs();
  for (uint32_t i = 0; i < pairs.size(); ++i) {
    recorder_.pick = pickId(PickKind::Contact, i);
    debug_.renderContact(world.states(), pairs[i], world.manifolds(pairs[i]));
  }
}

void WorldView::addIslands(const pfx::World& world) {
  recorder_.line_width = 2.5f;
  for (uint32_t i = 0; i < world.numIslands(); ++i) {
    recorder_.pick = pickId(PickKind::Island, i);
    debug_.renderIsland(i, world.island(i).bodies, world.states(), world.collidables());
  }
  recorder_.line_width = 1.5f;
}

void WorldView::addJoints(const pfx::World& world) {
  debug_.scale = kJointScale;
  const auto links = world.jointLinks();
  for (uint32_t i = 0; i < links.size(); ++i) {
    if (!links[i].exists) continue;
    recorder_.pick = pickId(PickKind::Joint, i);
    debug_.renderJoint(world.joints()[i], world.states()[links[i].body_a].pose(),
                       world.states()[links[i].body_b].pose());
  }
}

void WorldView::add(const pfx::World& world, const Overlays& overlays) {
  const auto states = world.states();
  debug_.resetVisible(uint32_t(states.size()));
  for (uint32_t body = 0; body < states.size(); ++body)
    debug_.setVisible(body, world.isValid(world.bodyId(body)));
  debug_.renderSolids(states, world.collidables());
  if (overlays.contacts) addContacts(world);
  if (overlays.joints) addJoints(world);
  if (overlays.islands) addIslands(world);
  recorder_.pick = 0;
  if (!marks_.empty()) {
    debug_.scale = kNormalLength;
    debug_.renderLargeMeshByFlag(states, world.collidables());
  }
  if (overlays.world) debug_.renderWorld(world.def().center, world.def().extent);
  addBodyOverlays(world, overlays);
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
