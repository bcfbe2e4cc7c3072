// Fills a draw list with a world: its bodies as solids, and the overlays that were asked for.
#pragma once

#include <map>
#include <optional>

#include "pfx/high_level/world/world.h"
#include "pfx/util/debug_render/debug_render.h"
#include "viewer/draw_list/draw_list.h"
#include "viewer/draw_list/recorder.h"
#include "viewer/run/overlay_scene.h"

namespace viewer {

// What is drawn beside the world itself.
struct ViewExtras {
  std::vector<uint8_t> selected = {};  // by body; empty: nothing is selected
  const Trails* trails = nullptr;
  std::optional<ProbeRay> probe = {};
  std::vector<Color> body_colors = {};  // by body, of its solids; 0 or missing: by its state
};

class WorldView {
 public:
  // The list must outlive the view.
  explicit WorldView(DrawList& list) : list_(list), recorder_(list), debug_(recorder_.callbacks()) {}

  // Adds everything; call it between begin() and end() of the list.
  void add(const pfx::World& world, const Overlays& overlays, const ViewExtras& extras = {});
  // Shows which triangle is meant: its outline, its normal, and its face tinted.
  void addTriangle(const pfx::World& world, uint32_t body, uint32_t facet, Color color);

  // What is drawn of single triangles of large meshes; a mark of None is no mark.
  void mark(const pfx::World& world, const pfx::MeshTriangleId& triangle, pfx::MeshDraw what);
  pfx::MeshDraw markOf(const pfx::MeshTriangleId& triangle) const;

 private:
  void addImmediate(const OverlayScene& scene);
  void addBodyOverlays(const OverlayScene& scene);
  void addContacts(const OverlayScene& scene);
  void addContactDepths(const OverlayScene& scene);
  void addJoints(const OverlayScene& scene);
  void addIslands(const OverlayScene& scene);
  void addMeshes(const OverlayScene& scene);

  DrawList& list_;
  Recorder recorder_;
  pfx::DebugRender debug_;
  std::map<pfx::MeshTriangleId, pfx::MeshDraw> marks_;
};

}  // namespace viewer
