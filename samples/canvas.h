// What a scene draws besides its bodies: rays, cloth, analytic answers, texts. Knows no graphics library.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "pfx/base_level/math/transform.h"
#include "pfx/base_level/shape/shape.h"
#include "pfx/util/debug_render/debug_render.h"

namespace samples {

struct Stroke {
  pfx::Color color = 0xff20242bu;  // 0xAARRGGBB
  float width = 1.5f;              // px; of a point: its diameter
};

// How a solid or a surface looks. A colour that is not opaque makes it translucent: a ghost.
struct Paint {
  pfx::Color color = 0xffc9a26bu;
  pfx::Finish finish = pfx::Finish::Soft;
};

// A triangle mesh that may change from frame to frame.
struct Surface {
  std::span<const pfx::Vec3> points;   // m, world
  std::span<const uint32_t> indices;   // three a triangle, counter-clockwise seen from outside
  bool two_sided = false;              // a sheet, to be seen from behind as well
};

class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual void line(const pfx::Vec3& from, const pfx::Vec3& to, const Stroke& stroke) = 0;
  virtual void arrow(const pfx::Vec3& from, const pfx::Vec3& to, const Stroke& stroke) = 0;
  virtual void point(const pfx::Vec3& position, const Stroke& stroke) = 0;
  virtual void label(const pfx::Vec3& position, std::string_view text) = 0;  // at a place in the world
  virtual void solid(const pfx::Geometry& geometry, const pfx::Transform& pose, const Paint& paint) = 0;
  virtual void surface(const Surface& surface, const Paint& paint) = 0;
};

}  // namespace samples
