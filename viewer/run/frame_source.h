// Where pictures of scenes come from. The golden flow sees only this, so that it is tested with synthetic
// pictures.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "viewer/image/image.h"
#include "viewer/run/scene_spec.h"

namespace viewer {

struct RenderedFrame {
  int frame = 0;            // steps made before the picture was taken
  uint64_t state_hash = 0;  // of the world in that moment
  Image image;
};

class FrameSource {
 public:
  virtual ~FrameSource() = default;

  // Names the rasteriser; pictures of two sources with the same name are equal up to rounding.
  virtual std::string fingerprint() const = 0;

  // Runs the scene from its start and hands over the picture of each frame number (ascending). Throws what
  // the scene or the renderer throws.
  virtual void render(const SceneSpec& scene, std::span<const int> frames,
                      const std::function<void(RenderedFrame&&)>& use) = 0;
};

// Called once in every thread that draws.
using FrameSourceFactory = std::function<std::unique_ptr<FrameSource>()>;

}  // namespace viewer
