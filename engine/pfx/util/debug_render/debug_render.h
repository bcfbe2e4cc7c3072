// Draws the engine's data through callbacks. Knows no graphics library.
//
// Two kinds of callback:
//   immediate  - point, line, arc, axis-aligned box, oriented box: the five of the overview;
//   retained   - solid shapes: a geometry is announced once under a key (its content hash) and then drawn with one
//                batched call per key and frame, with an instance for each body that wears it.
// A callback that is not set is skipped. Colours are 0xAARRGGBB.
#pragma once

#include <cstdint>
#include <span>
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
  Transform pose;      // shape frame to world
  Color color;         // of the surface
  Finish finish;
  uint32_t body;       // index of the body, for picking
};

struct DebugRenderCallbacks {
  void* context = nullptr;  // passed to every callback
  void (*point)(void*, const Vec3& position, Color) = nullptr;
  void (*line)(void*, const Vec3& from, const Vec3& to, Color) = nullptr;
  // Arc about `axis` from start to end (rad, counted from `direction`).
  void (*arc)(void*, const Vec3& center, const Vec3& axis, const Vec3& direction, float radius, float start, float end,
              Color) = nullptr;
  void (*aabb)(void*, const Vec3& center, const Vec3& half_extent, Color) = nullptr;
  void (*box)(void*, const Transform& pose, const Vec3& half_extent, Color) = nullptr;
  // Announces a geometry; called before the first drawSolids with this key.
  void (*define_solid)(void*, uint64_t key, const Geometry&) = nullptr;
  // Draws all instances of one geometry of this frame.
  void (*draw_solids)(void*, uint64_t key, std::span<const SolidInstance>) = nullptr;
};

}  // namespace pfx
