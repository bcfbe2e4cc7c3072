// How pairs are found, and what a ray, a swept ball and an overlap find.
#include <algorithm>
#include <array>
#include <cstdio>

#include "pfx/util/debug_render/palette.h"
#include "viewer/inspect/body_facts.h"
#include "viewer/run/overlay_scene.h"

namespace viewer {
namespace {

using pfx::Vec3;

constexpr size_t kMostBoxes = 4000;  // more hide each other
constexpr Color kRayColor = 0xffd9480f, kCastColor = 0xff2f6fb0, kOverlapColor = 0xff8a4fb0, kSweepColor = 0xff1f8a4c;

void addTrees(const OverlayScene& scene, std::span<const pfx::TreeBox> boxes) {
  std::array<size_t, 64> count{};
  for (const pfx::TreeBox& b : boxes) ++count[std::min<size_t>(b.level, count.size() - 1)];
  // Whole levels from the root down.
  size_t levels = 0, sum = 0;
  while (levels < count.size() && count[levels] > 0 && (levels == 0 || sum + count[levels] <= kMostBoxes))
    sum += count[levels++];
  for (const pfx::TreeBox& b : boxes)
    if (b.level < levels)
      addBox(scene.list, {b.bounds.center(), pfx::Quat::Identity()}, b.bounds.halfExtent(),
             {{}, {}, pfx::indexColor(b.level), b.is_leaf ? 1.0f : 2.0f, 0});
  for (size_t level = 0; level < levels; ++level)
    scene.list.add(LegendEntry{pfx::indexColor(uint32_t(level)),
                               "tree level " + std::to_string(level) + ": " + std::to_string(count[level]) + " boxes"});
}

// The extent of each body along the axis: what the sweep sorts and compares first.
void addSweep(const OverlayScene& scene, int axis) {
  const auto states = scene.world.states();
  for (uint32_t body = 0; body < states.size(); ++body) {
    if (!scene.exists(body) || !scene.shows(body) || states[body].motion_type == pfx::MotionType::Fixed) continue;
    const pfx::Collidable& c = scene.world.collidables()[body];
    const pfx::Aabb box = pfx::transformedAabb(states[body].pose(), c.center, c.half_extent);
    // Along the edge of its bounds that is nearest to the eye.
    const Vec3 towards = scene.list.camera.eye - box.center();
    Vec3 edge = box.center() + box.halfExtent().cwiseProduct(towards.cwiseSign());
    const Vec3 half = box.halfExtent()[axis] * Vec3::Unit(axis);
    edge[axis] = box.center()[axis];
    scene.list.add(Arrow{edge - half, edge + half, kSweepColor, 2.0f, pickId(PickKind::Body, body)});
  }
  scene.list.add(LegendEntry{kSweepColor, std::string("sweep along ") + "xyz"[axis]});
}

void addRayHit(const OverlayScene& scene, const ProbeRay& probe) {
  const pfx::RayOutput hit = scene.world.castRay({.start = probe.start, .direction = probe.way});
  if (!hit.hit) return;
  const uint32_t pick = pickId(PickKind::Body, hit.body);
  scene.list.add(Point{hit.point, kRayColor, 9.0f, pick});
  scene.list.add(Arrow{hit.point, hit.point + 0.5f * scene.unit * hit.normal, kRayColor, 2.5f, pick});
  char text[48];
  std::snprintf(text, sizeof text, "ray: %.4g m to ", double(hit.fraction) * double(probe.way.norm()));
  scene.list.add(Label{.position = hit.point, .text = text + bodyTitle(scene.world, hit.body)});
}

// A ball is swept along the ray; the bodies within a radius of where it is stopped are those that overlap a larger one.
void addBallCast(const OverlayScene& scene, const ProbeRay& probe) {
  const float radius = 0.25f * scene.unit;
  const pfx::Geometry ball = pfx::Sphere{radius};
  const pfx::ShapeCastOutput hit =
      scene.world.castShape({.geometry = ball, .start = {probe.start, pfx::Quat::Identity()}, .motion = probe.way});
  if (!hit.hit) return;
  const Vec3 center = probe.start + hit.fraction * probe.way;
  scene.list.add(kRound, {.position = center,
                          .scale = Vec3(0.0f, radius, radius),
                          .color = (kCastColor & 0x00ffffffu) | 0x80000000u,
                          .finish = uint32_t(pfx::Finish::Translucent)});
  scene.list.add(Arrow{hit.point, hit.point + 0.5f * scene.unit * hit.normal, kCastColor, 2.5f, 0});
  std::vector<uint32_t> near;
  scene.world.findOverlaps({.geometry = ball, .pose = {center, pfx::Quat::Identity()}, .margin = radius}, near);
  for (uint32_t body : near) {
    if (scene.world.states()[body].motion_type == pfx::MotionType::Fixed) continue;
    const pfx::Collidable& c = scene.world.collidables()[body];
    const pfx::Aabb box = pfx::transformedAabb(scene.world.states()[body].pose(), c.center, c.half_extent);
    addBox(scene.list, {box.center(), pfx::Quat::Identity()}, box.halfExtent(), {{}, {}, kOverlapColor, 2.0f, 0});
  }
  scene.list.add(LegendEntry{kCastColor, "ball swept along the ray"});
  scene.list.add(LegendEntry{kOverlapColor, "bodies within its radius: " + std::to_string(near.size())});
}

}  // namespace

void addPairSearch(const OverlayScene& scene) {
  if (const int axis = scene.world.sweepAxis(); axis >= 0)
    addSweep(scene, axis);
  else
    addTrees(scene, scene.world.treeBoxes());
}

void addProbe(const OverlayScene& scene, const ProbeRay& probe) {
  addRayHit(scene, probe);
  addBallCast(scene, probe);
}

}  // namespace viewer
