// Lets the engine's debug-render callbacks record into a draw list.
#pragma once

#include <map>

#include "pfx/util/debug_render/debug_render.h"
#include "viewer/draw_list/draw_list.h"

namespace viewer {

// Where the solid of a geometry is found in a list: its mesh, and the scale that makes it of that mesh.
struct Placement {
  uint64_t mesh;
  pfx::Vec3 scale;
};

// How long a list knows the mesh of a geometry: for good, or until a frame does not show it.
enum class Lifetime : uint8_t { Kept, Transient };

// The placement of a geometry, whose mesh is made known under `key` if it is none of the unit meshes.
Placement placementOf(uint64_t key, const pfx::Geometry& geometry, DrawList& list,
                      Lifetime lifetime = Lifetime::Kept);

// Keep one recorder beside each list: it remembers which of the engine's keys became which mesh. The
// callbacks point to the recorder, which must outlive them.
class Recorder {
 public:
  explicit Recorder(DrawList& list) : list_(&list) {}
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // All callbacks set. draw_solids ignores keys that were never announced.
  pfx::DebugRenderCallbacks callbacks();

  // Forgets the engine's keys: call it when the world is another one.
  void reset() { placements_.clear(); }

  float line_width = 1.5f;  // px, of lines that follow
  float point_size = 7.0f;  // px
  uint32_t pick = 0;        // id of immediate items that follow
  std::vector<Color> body_colors;  // by body: of its solids instead of their own; 0 or missing: their own
  Lifetime lifetime = Lifetime::Kept;  // of meshes that are announced

 private:
  Line style(pfx::Color color) const { return {{}, {}, color, line_width, pick}; }
  void draw(uint64_t key, std::span<const pfx::SolidInstance> instances);

  DrawList* list_;
  std::map<uint64_t, Placement> placements_;
};

// Edges of a box, and an arc as a polyline of chords of at most 7.5 degrees; what the callbacks use.
void addBox(DrawList& list, const pfx::Transform& pose, const pfx::Vec3& half_extent, const Line& style);
struct Arc {
  pfx::Vec3 center, axis, direction;  // m; unit; unit, across the axis
  float radius, start, end;           // m; rad
};
void addArc(DrawList& list, const Arc& arc, const Line& style);

}  // namespace viewer
