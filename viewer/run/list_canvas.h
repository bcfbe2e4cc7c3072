// Lets a scene draw into a draw list.
#pragma once

#include "samples/canvas.h"
#include "viewer/draw_list/draw_list.h"

namespace viewer {

// For one frame: between begin() and end() of the list, which must outlive it.
class ListCanvas : public samples::Canvas {
 public:
  explicit ListCanvas(DrawList& list) : list_(list) {}

  void line(const pfx::Vec3& from, const pfx::Vec3& to, const samples::Stroke& stroke) override;
  void arrow(const pfx::Vec3& from, const pfx::Vec3& to, const samples::Stroke& stroke) override;
  void point(const pfx::Vec3& position, const samples::Stroke& stroke) override;
  void label(const pfx::Vec3& position, std::string_view text) override;
  void solid(const pfx::Geometry& geometry, const pfx::Transform& pose, const samples::Paint& paint) override;
  void surface(const samples::Surface& surface, const samples::Paint& paint) override;

 private:
  DrawList& list_;
};

}  // namespace viewer
