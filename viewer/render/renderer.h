// Draws a draw list with OpenGL 3.3 core into framebuffers of its own.
//
// A picture is a function of FrameInput, DrawList and the parameters: nothing else is remembered that shows.
// All GL objects belong to the renderer, so that several can live in one process and on one context.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "viewer/context/gl_context.h"
#include "viewer/draw_list/draw_list.h"
#include "viewer/image/image.h"

struct ImDrawData;

namespace viewer {

enum class Quality {
  Ci,      // 2x2 samples a pixel, small shadow map: the golden images
  Window,  // one sample a pixel, larger shadow map: someone looks at it from near by
  Hero,    // 3x3 samples, large shadow map, ambient occlusion: pictures for the README
};

struct RenderParams {
  Quality quality = Quality::Ci;
  bool wire = false;       // draws the edges of all triangles, not only where faces meet at an angle
  std::string shader_dir = {};  // read shaders from here instead of the built-in ones; empty: built in
};

struct FrameInput {
  int width = 640, height = 360;   // px, 1 .. 8192
  const ImDrawData* ui = nullptr;  // painted on top, one unit a pixel
  uint32_t selected = 0;           // pick id to outline; 0: none
  float label_scale = 1.0f;        // of text, whole numbers are sharpest
  float covered_right = 0.0f;      // px at the right that the user interface covers: the legend keeps clear of it
};

struct RenderStats {
  uint32_t draw_calls = 0, instances = 0, triangles = 0, lines = 0;
  size_t uploaded_bytes = 0;  // instances, lines and meshes sent in this frame
};

struct PickHit {
  uint32_t id = 0;                          // pick id; 0: nothing
  pfx::Vec3 position = pfx::Vec3::Zero();   // m, of the visible surface; the far plane when there is nothing
};

// GL reported an error, a shader did not compile, or a size is out of range.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Renderer {
 public:
  explicit Renderer(GlContext& context, const RenderParams& params = {});  // throws RenderError
  ~Renderer();  // frees what it made; the context must still exist

  // Draws into the renderer's own picture. Throws RenderError when GL reports an error.
  RenderStats draw(const FrameInput& frame, const DrawList& list);

  // The last picture. Throws RenderError before the first draw, and when all its pixels are equal although
  // the list had something in it (a blank picture is a fault, not a result).
  Image readBack();

  // What is under a pixel of a picture (0,0: top left). Draws an id pass, so it costs nothing unless called.
  PickHit pick(const FrameInput& frame, const DrawList& list, int x, int y);
  // The id of every pixel, rows from top to bottom: for tests and counts of what is visible.
  std::vector<uint32_t> readIds(const FrameInput& frame, const DrawList& list);

  // Copies the last picture to the framebuffer of the window.
  void blit(int window_width, int window_height);

  // Names the rasteriser: GL_RENDERER and GL_VERSION. Part of a golden image's identity.
  std::string fingerprint() const;
  static std::string rasterizer(GlContext& context);  // GL_RENDERER alone

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viewer
