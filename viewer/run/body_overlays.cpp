// Masses, names and trajectories of bodies; what is written at islands.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pfx/util/debug_render/palette.h"
#include "viewer/inspect/island_facts.h"
#include "viewer/run/overlay_scene.h"

namespace viewer {
namespace {

using pfx::Vec3;

constexpr Color kMassColor = 0xff5a4fa8;

bool isMoved(const OverlayScene& scene, uint32_t body) {
  return scene.shows(body) && scene.exists(body) && pfx::isDynamic(scene.world.states()[body].motion_type);
}

// Half extents of the box of uniform density with principal moments i and mass m: i_x = m (h_y^2 + h_z^2) / 3.
Vec3 inertiaBox(const Vec3& i, float mass) {
  const Vec3 squares = 1.5f / mass * Vec3(i.y() + i.z() - i.x(), i.z() + i.x() - i.y(), i.x() + i.y() - i.z());
  return squares.cwiseMax(0.0f).cwiseSqrt();
}

}  // namespace

void addMasses(const OverlayScene& scene) {
  for (uint32_t body = 0; body < scene.world.states().size(); ++body) {
    if (!isMoved(scene, body)) continue;
    const pfx::RigidState& s = scene.world.states()[body];
    const pfx::RigidBody& b = scene.world.bodies()[body];
    const uint32_t pick = pickId(PickKind::Body, body);
    scene.list.add(Point{s.position, kMassColor, 8.0f, pick});
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> principal{Eigen::Matrix3f(b.inertia)};
    if (principal.info() != Eigen::Success || !(b.mass > 0.0f)) continue;
    Eigen::Matrix3f axes = principal.eigenvectors();
    if (axes.determinant() < 0.0f) axes.col(0) = -axes.col(0);
    const pfx::Quat turn(s.orientation * pfx::Quat(pfx::Mat3(axes)));
    addBox(scene.list, {s.position, turn}, inertiaBox(Vec3(principal.eigenvalues()), b.mass),
           {{}, {}, kMassColor, 1.5f, pick});
  }
}

void addNames(const OverlayScene& scene) {
  for (uint32_t body = 0; body < scene.world.states().size(); ++body)
    if (isMoved(scene, body))
      scene.list.add(Label{.position = scene.world.states()[body].position, .text = bodyTitle(scene.world, body)});
}

void addTrails(const OverlayScene& scene, const Trails& trails) {
  for (size_t step = 1; step < trails.size(); ++step) {
    const auto alpha = Color(40 + 200 * step / trails.size()) << 24;  // older parts fade
    const size_t count = std::min(trails[step - 1].size(), trails[step].size());
    for (uint32_t body = 0; body < count && body < scene.world.states().size(); ++body) {
      if (!isMoved(scene, body) || (trails[step][body] - trails[step - 1][body]).squaredNorm() < 1e-8f) continue;
      scene.list.add(Line{trails[step - 1][body], trails[step][body],
                          (pfx::indexColor(body) & 0x00ffffffu) | alpha, 2.0f, pickId(PickKind::Body, body)});
    }
  }
}

std::vector<Color> islandColors(const pfx::World& world) {
  std::vector<Color> colors(world.states().size(), 0);
  for (uint32_t i = 0; i < world.numIslands(); ++i)
    for (uint32_t body : world.island(i).bodies)
      if (body < colors.size()) colors[body] = pfx::indexColor(i);
  return colors;
}

namespace {

// The largest speed (m/s) at which points that carry load still approach each other: what the solver left over.
double approachSpeed(const pfx::World& world, const pfx::IslandView& island) {
  double fastest = 0.0;
  const auto states = world.states();
  for (uint32_t i : island.contacts) {
    const pfx::Pair& pair = world.contactPairs()[i];
    const pfx::RigidState &a = states[pair.body_a], &b = states[pair.body_b];
    for (const pfx::ContactManifold& m : world.manifolds(pair))
      for (int k = 0; k < m.num_points; ++k) {
        const pfx::ContactPoint& p = m.points[size_t(k)];
        if (!(p.normal_impulse > 0.0f)) continue;
        const Vec3 at = b.pose().apply(p.local_b);
        const Vec3 speed = b.linear_velocity + b.angular_velocity.cross(at - b.position) - a.linear_velocity -
                           a.angular_velocity.cross(at - a.position);
        fastest = std::max(fastest, double(-speed.dot(m.normal)));
      }
  }
  return fastest;
}

std::string solverText(const pfx::World& world, uint32_t index) {
  const pfx::IslandView island = world.island(index);
  float overlap = 0.0f;
  for (uint32_t pair : island.contacts)
    for (const pfx::ContactManifold& m : world.manifolds(world.contactPairs()[pair]))
      for (int k = 0; k < m.num_points; ++k) overlap = std::max(overlap, -m.points[size_t(k)].distance);
  double joint = 0.0;
  for (uint32_t i : jointsOf(world, island)) joint = std::max(joint, world.jointError(i).distance);
  std::string text = solverName(world, index);
  const auto add = [&](const char* format, double value) {
    char part[64];
    std::snprintf(part, sizeof part, format, value);
    text += part;
  };
  if (!island.contacts.empty()) {
    add("; overlap %.3g mm", 1e3 * double(overlap));
    add(", left over %.3g mm/s", 1e3 * approachSpeed(world, island));
  }
  if (island.joints > 0) add("; joints %.3g mm", 1e3 * joint);
  return text;
}

}  // namespace

void addIslandLabels(const OverlayScene& scene) {
  constexpr uint32_t kMost = 60;  // labels: more cannot be read
  const pfx::World& world = scene.world;
  uint32_t shown = 0;
  for (uint32_t i = 0; i < world.numIslands() && shown < kMost; ++i) {
    const pfx::IslandView island = world.island(i);
    Vec3 top = Vec3::Constant(-1e30f), sum = Vec3::Zero();
    float count = 0.0f;
    for (uint32_t body : island.bodies)
      if (scene.shows(body)) {
        const pfx::RigidState& s = world.states()[body];
        const pfx::Collidable& c = world.collidables()[body];
        top = top.cwiseMax(pfx::transformedAabb(s.pose(), c.center, c.half_extent).max);
        sum += s.position;
        count += 1.0f;
      }
    if (count == 0.0f) continue;
    ++shown;
    const Vec3 at(sum.x() / count, top.y() + 0.06f * scene.unit, sum.z() / count);
    const std::string name = "island " + std::to_string(i) + ": ";
    // Two lines, so that both can be shown.
    if (scene.overlays.sleep) scene.list.add(Label{.position = at, .text = name + explainSleep(world, i).why});
    if (scene.overlays.solver)
      scene.list.add(Label{.position = at + Vec3(0.0f, scene.overlays.sleep ? 0.12f * scene.unit : 0.0f, 0.0f),
                           .text = name + solverText(world, i)});
  }
}

}  // namespace viewer
