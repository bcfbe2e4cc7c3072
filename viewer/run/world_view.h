// Fills a draw list with a world: its bodies as solids, and the overlays that were asked for.
#pragma once

#include "pfx/high_level/world/world.h"
#include "viewer/draw_list/draw_list.h"
#include "viewer/draw_list/recorder.h"
#include "viewer/run/overlays.h"

namespace viewer {

class WorldView {
 public:
  // The list must outlive the view.
  explicit WorldView(DrawList& list) : list_(list), recorder_(list) {}

  // Adds everything; call it between begin() and end() of the list.
  void add(const pfx::World& world, const Overlays& overlays);

 private:
  DrawList& list_;
  Recorder recorder_;
};

// The colour of an island, group or body number: neighbours in number differ clearly.
Color paletteColor(uint32_t index);

}  // namespace viewer
