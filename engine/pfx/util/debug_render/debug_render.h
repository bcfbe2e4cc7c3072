// Draws the engine's data through callbacks. Knows no graphics library.
//
// Two kinds of callback:
//   immediate  - point, line, arc, axis-aligned box, oriented box: the five of the overview;
//   retained   - solid shapes: a geometry is announced once under a key (its content hash) and then drawn
//   with one
//                batched call per key and frame, with an instance for each body that wears it.
// A callback that is not set is skipped. Colours are 0xAARRGGBB.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/rigid_body/rigid_body.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/shape/collidable.h"

namespace pfx {

using Color = uint32_t;  // 0xAARRGGBB

// How a surface looks, so that the state of a body shows by finish as well as by hue.
enum class Finish : uint8_t { Soft, Matte, Glossy, Metallic, Dead, Translucent };

struct SolidInstance {
  Transform pose;  // shape frame to world
  Color color;     // of the surface
  Finish finish;
  uint32_t body;  // index of the body, for picking
};

struct DebugRenderCallbacks {
  void* context = nullptr;  // passed to every callback
  void (*point)(void*, const Vec3& position, Color) = nullptr;
  void (*line)(void*, const Vec3& from, const Vec3& to, Color) = nullptr;
  // Arc about `axis` from start to end (rad, counted from `direction`).
  void (*arc)(void*, const Vec3& center, const Vec3& axis, const Vec3& direction, float radius, float start,
              float end, Color) = nullptr;
  void (*aabb)(void*, const Vec3& center, const Vec3& half_extent, Color) = nullptr;
  void (*box)(void*, const Transform& pose, const Vec3& half_extent, Color) = nullptr;
  // Announces a geometry; called before the first drawSolids with this key.
  void (*define_solid)(void*, uint64_t key, const Geometry&) = nullptr;
  // Draws all instances of one geometry of this frame.
  void (*draw_solids)(void*, uint64_t key, std::span<const SolidInstance>) = nullptr;
};

// Draws what the stages work on. Immediate methods call back once per item; nothing is remembered between
// calls except which bodies are visible. Spans by body index have the length of `states`.
class DebugRender {
 public:
  explicit DebugRender(const DebugRenderCallbacks& callbacks_in = {}) : callbacks(callbacks_in) {}

  DebugRenderCallbacks callbacks;
  float scale = 1.0f;  // m, length of axes and normals

  // Makes bodies 0 .. count - 1 visible. Bodies that were never named are visible.
  void resetVisible(uint32_t count);
  void setVisible(uint32_t body, bool visible);
  bool getVisible(uint32_t body) const { return body >= hidden_.size() || !hidden_[body]; }

  // The box of the world: one aabb.
  void renderWorld(const Vec3& center, const Vec3& extent);
  // One aabb per visible body.
  void renderAabb(std::span<const RigidState> states, std::span<const Collidable> collidables);
  // Three lines per visible body: x red, y green, z blue.
  void renderLocalAxis(std::span<const RigidState> states);
  // One aabb around the visible ones among `bodies` (indices), in a colour of its own for each `island`.
  void renderIsland(uint32_t island, std::span<const uint32_t> bodies, std::span<const RigidState> states,
                    std::span<const Collidable> collidables);
  // One point and one line along the outward normal, for each contact point and visible body of the pair.
  void renderContact(std::span<const RigidState> states, const Pair& pair,
                     std::span<const ContactManifold> manifolds);

  // The solid shapes of all visible bodies, coloured by bodyLook: one draw_solids call for each geometry in
  // use. Geometries keep their place and key from call to call. Does not allocate once every geometry was
  // seen.
  void renderSolids(std::span<const RigidState> states, std::span<const Collidable> collidables);
  // To be called when a mesh that was drawn has changed or gone: geometries are announced anew.
  void forgetSolids();

 private:
  // A geometry, its key, and the instances of this frame.
  struct Group {
    Geometry geometry;
    uint64_t key;
    std::vector<SolidInstance> instances;
  };

  uint32_t groupOf(const Geometry& geometry);
  void addInstances(uint32_t body, const RigidState& state, std::span<const Shape> shapes,
                    std::span<uint32_t> groups);

  std::vector<bool> hidden_;   // by body
  std::vector<Group> groups_;  // in the order in which geometries were first seen
  std::unordered_map<uint64_t, uint32_t> group_of_identity_;
  std::vector<uint32_t> last_group_;  // by shape, those of a body in a row: its group in the last call
};

}  // namespace pfx
