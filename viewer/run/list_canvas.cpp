#include "viewer/run/list_canvas.h"

#include <utility>
#include <vector>

#include "pfx/util/debug_render/geometry_key.h"
#include "pfx/util/state_hash/state_hash.h"
#include "viewer/draw_list/recorder.h"

namespace viewer {

using pfx::Vec3;

void ListCanvas::line(const Vec3& from, const Vec3& to, const samples::Stroke& stroke) {
  list_.add(Line{from, to, stroke.color, stroke.width});
}

void ListCanvas::arrow(const Vec3& from, const Vec3& to, const samples::Stroke& stroke) {
  list_.add(Arrow{from, to, stroke.color, stroke.width});
}

void ListCanvas::point(const Vec3& position, const samples::Stroke& stroke) {
  list_.add(Point{position, stroke.color, stroke.width});
}

void ListCanvas::label(const Vec3& position, std::string_view text) {
  list_.add(Label{.position = position, .text = std::string(text)});
}

void ListCanvas::solid(const pfx::Geometry& geometry, const pfx::Transform& pose, const samples::Paint& paint) {
  const Placement place = placementOf(pfx::geometryKey(geometry), geometry, list_);
  list_.add(place.mesh, {pose.position, pose.orientation, place.scale, paint.color, uint32_t(paint.finish), 0});
}

// A sheet is drawn as two surfaces, back to back, since only front faces are drawn; two meshes, so that each has the
// normals and feature edges of a surface.
void ListCanvas::surface(const samples::Surface& surface, const samples::Paint& paint) {
  const uint64_t points = pfx::hashBytes(std::as_bytes(surface.points));
  const auto add = [&](std::span<const uint32_t> indices) {
    const uint64_t key = points ^ pfx::hashBytes(std::as_bytes(indices));
    list_.defineTransientMesh(key, [&] { return makeMesh(surface.points, indices); });
    list_.add(key, {.color = paint.color, .finish = uint32_t(paint.finish)});
  };
  add(surface.indices);
  if (!surface.two_sided) return;
  std::vector<uint32_t> back(surface.indices.begin(), surface.indices.end());
  for (size_t i = 0; i + 3 <= back.size(); i += 3) std::swap(back[i + 1], back[i + 2]);
  add(back);
}

}  // namespace viewer
