// A world as solids and overlays.
#include "viewer/run/world_view.h"

#include <xxhash.h>

#include <array>
#include <map>

#include "pfx/base_level/shape/aabb.h"

namespace viewer {
namespace {

using pfx::Vec3;

constexpr Color kFixedColor = 0xff9aa3ad, kKeyframeColor = 0xff5b8dbe, kTriggerColor = 0x603fae6a;
constexpr Color kAabbColor = 0xff3d7fc1, kContactColor = 0xffd7263d, kVelocityColor = 0xff1f8a4c, kWorldColor = 0xff6b7280;
constexpr float kArrowSeconds = 0.25f;    // s, a velocity arrow shows the way of this time
constexpr float kNormalLength = 0.3f;     // m

// Names a geometry within one picture.
uint64_t geometryKey(const pfx::Geometry& geometry) {
  const uint64_t seed = geometry.index();
  return std::visit([&](const auto& g) { return XXH3_64bits_withSeed(&g, sizeof g, seed); }, geometry);
}

pfx::SolidInstance bodyInstance(const pfx::World& world, uint32_t body, const pfx::Shape& shape) {
  const pfx::RigidState& s = world.states()[body];
  pfx::SolidInstance out{s.pose() * shape.offset, paletteColor(body), pfx::Finish::Soft, body};
  switch (s.motion_type) {
    case pfx::MotionType::Fixed: out.color = kFixedColor, out.finish = pfx::Finish::Matte; break;
    case pfx::MotionType::Keyframe: out.color = kKeyframeColor, out.finish = pfx::Finish::Metallic; break;
    case pfx::MotionType::OneWay: out.finish = pfx::Finish::Glossy; break;
    case pfx::MotionType::Trigger: out.color = kTriggerColor, out.finish = pfx::Finish::Translucent; break;
    case pfx::MotionType::Active: break;
  }
  if (s.asleep) out.finish = pfx::Finish::Dead;
  return out;
}

void addSolids(const pfx::World& world, const pfx::DebugRenderCallbacks& callbacks) {
  std::map<uint64_t, std::vector<pfx::SolidInstance>> batches;
  for (uint32_t body = 0; body < world.states().size(); ++body) {
    if (!world.bodyId(body)) continue;
    for (const pfx::Shape& shape : world.collidables()[body].shapes()) {
      const uint64_t key = geometryKey(shape.geometry);
      auto& batch = batches[key];
      if (batch.empty()) callbacks.define_solid(callbacks.context, key, shape.geometry);
      batch.push_back(bodyInstance(world, body, shape));
    }
  }
  for (const auto& [key, batch] : batches) callbacks.draw_solids(callbacks.context, key, batch);
}

pfx::Aabb bodyBounds(const pfx::World& world, uint32_t body) {
  const pfx::Collidable& c = world.collidables()[body];
  return pfx::transformedAabb(world.states()[body].pose(), c.center, c.half_extent);
}

void addBounds(DrawList& list, const pfx::Aabb& box, const Line& style) {
  addBox(list, {box.center(), pfx::Quat::Identity()}, box.halfExtent(), style);
}

void addBodyOverlays(DrawList& list, const pfx::World& world, uint32_t body, const Overlays& overlays) {
  const pfx::RigidState& s = world.states()[body];
  const uint32_t pick = pickId(PickKind::Body, body);
  if (overlays.aabb && s.motion_type != pfx::MotionType::Fixed)
    addBounds(list, bodyBounds(world, body), {{}, {}, kAabbColor, 1.5f, pick});
  if (overlays.velocity && s.linear_velocity.squaredNorm() > 1e-4f)
    list.add(Arrow{s.position, s.position + kArrowSeconds * s.linear_velocity, kVelocityColor, 2.0f, pick});
  if (overlays.axes && s.motion_type != pfx::MotionType::Fixed) {
    constexpr std::array<Color, 3> kAxes = {0xffd7263d, 0xff2e9e4f, 0xff2f6fd0};
    const float length = 0.7f * world.collidables()[body].half_extent.norm();
    for (int i = 0; i < 3; ++i)
      list.add(Arrow{s.position, s.pose().apply(length * Vec3::Unit(i)), kAxes[size_t(i)], 2.0f, pick});
  }
}

void addContacts(DrawList& list, const pfx::World& world) {
  const auto pairs = world.contactPairs();
  for (uint32_t i = 0; i < pairs.size(); ++i) {
    const pfx::Transform pose = world.states()[pairs[i].body_a].pose();
    const uint32_t pick = pickId(PickKind::Contact, i);
    for (const pfx::ContactManifold& m : world.manifolds(pairs[i]))
      for (int k = 0; k < m.num_points; ++k) {
        const Vec3 at = pose.apply(m.points[size_t(k)].local_a);
        list.add(Point{at, kContactColor, 6.0f, pick});
        list.add(Arrow{at, at + kNormalLength * m.normal, kContactColor, 1.5f, pick});
      }
  }
}

void addIslands(DrawList& list, const pfx::World& world) {
  for (uint32_t i = 0; i < world.numIslands(); ++i) {
    pfx::Aabb box;
    for (uint32_t body : world.island(i).bodies) box.extend(bodyBounds(world, body));
    if (box.min.x() <= box.max.x())
      addBounds(list, box.grown(0.05f), {{}, {}, paletteColor(i), 2.0f, pickId(PickKind::Island, i)});
  }
}

}  // namespace

Color paletteColor(uint32_t index) {
  static constexpr std::array<Color, 8> kPalette = {0xffe0a458, 0xff6a9bd1, 0xffd9756b, 0xff7fb685,
                                                    0xffb28dc9, 0xffe6c75a, 0xff5fb3b3, 0xffc58a6a};
  return kPalette[index % kPalette.size()];
}

void WorldView::add(const pfx::World& world, const Overlays& overlays) {
  addSolids(world, recorder_.callbacks());
  if (overlays.aabb || overlays.axes || overlays.velocity)
    for (uint32_t body = 0; body < world.states().size(); ++body)
      if (world.bodyId(body)) addBodyOverlays(list_, world, body, overlays);
  if (overlays.contacts) addContacts(list_, world);
  if (overlays.islands) addIslands(list_, world);
  if (overlays.world) {
    const pfx::WorldDef& def = world.def();
    addBox(list_, {def.center, pfx::Quat::Identity()}, def.extent, {{}, {}, kWorldColor, 1.5f, 0});
  }
}

}  // namespace viewer
