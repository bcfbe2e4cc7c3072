// The passes of a frame, one file each. A pass owns its programs and draws into the target that is bound.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "viewer/render/frame_block.h"
#include "viewer/render/gl_state.h"
#include "viewer/render/program.h"
#include "viewer/render/shadow_reach.h"
#include "viewer/render/solid_store.h"
#include "viewer/render/target.h"

struct ImDrawData;
struct ImDrawList;
struct ImFontAtlas;

namespace viewer {

// Depth of all opaque solids as the sun sees them.
class ShadowPass {
 public:
  ShadowPass(const Gl& gl, const std::string& shaders, int map_size);
  void draw(std::span<const SolidDraw> draws, const SunView& sun) const;
  GLuint map() const { return target_.depth(); }

 private:
  const Gl* gl_;
  Program triangles_, round_;
  Target target_;
};

// Lit solids.
class SolidPass {
 public:
  struct Options {
    bool wide_shadow;  // softer shadows, twice the look-ups
    bool wire;         // shows all edges of triangles
  };
  SolidPass(const Gl& gl, const std::string& shaders, const Options& options);
  struct Shadow {
    GLuint map;
    ScreenRect reach;  // outside of it floors are in the sun
  };
  void draw(std::span<const SolidDraw> draws, const FrameBlock& frame, const Shadow& shadow) const;
  void drawTranslucent(std::span<const SolidDraw> draws, const FrameBlock& frame, GLuint shadow_map) const;

 private:
  void drawDepth(std::span<const SolidDraw> draws, const FrameBlock& frame) const;
  void drawFloors(std::span<const SolidDraw> draws, const FrameBlock& frame, const ScreenRect& reach) const;
  void useShadow(GLuint shadow_map) const;
  const Gl* gl_;
  Program depth_, plain_, shiny_, floor_, sunny_floor_, plain_round_, shiny_round_;
};

// The sky where nothing was drawn.
class SkyPass {
 public:
  SkyPass(const Gl& gl, const std::string& shaders);
  void draw() const;

 private:
  const Gl* gl_;
  Program program_;
  GlVertexArray array_;
};

// Pick ids of solids and overlays.
class IdPass {
 public:
  IdPass(const Gl& gl, const std::string& shaders);
  void draw(std::span<const SolidDraw> draws, const FrameBlock& frame) const;

 private:
  const Gl* gl_;
  Program triangles_, round_;
};

// Lines, arrows and points; what lies behind solids is dimmed.
class OverlayPass {
 public:
  OverlayPass(const Gl& gl, const std::string& shaders);
  size_t update(const DrawList& list);               // returns the bytes sent
  void draw(int width, int height, int side) const;  // size of the target in samples
  void drawIds(int width, int height) const;
  size_t count() const { return count_; }

 private:
  void drawQuads(const Program& program, int width, int height, int side) const;
  const Gl* gl_;
  Program color_, ids_;
  GlVertexArray array_;
  GlBuffer buffer_;
  size_t count_ = 0;
};

// Darkens what is enclosed by its surroundings, from the depth buffer.
class OcclusionPass {
 public:
  OcclusionPass(const Gl& gl, const std::string& shaders);
  // Multiplies the colour of `scene` by the light that reaches it; needs its depth.
  void draw(const Target& scene, const FrameBlock& frame, float radius_m);

 private:
  const Gl* gl_;
  Program estimate_, blur_;
  GlVertexArray array_;
  Target occlusion_;
};

// Samples to pixels.
class ResolvePass {
 public:
  ResolvePass(const Gl& gl, const std::string& shaders);
  void draw(GLuint samples, int side) const;

 private:
  const Gl* gl_;
  Program program_;
  GlVertexArray array_;
};

// A line round what is selected.
class OutlinePass {
 public:
  OutlinePass(const Gl& gl, const std::string& shaders);
  void draw(GLuint ids, uint32_t selected) const;

 private:
  const Gl* gl_;
  Program program_;
  GlVertexArray array_;
};

// Text of labels, legend and scale bar, with a halo.
class LabelPass {
 public:
  LabelPass(const Gl& gl, const std::string& shaders);
  struct Input {
    const FrameBlock* frame;
    GLuint depth;
    int width, height;  // px
    float scale;        // of the text
    float covered_right;  // px
  };
  void draw(const DrawList& list, const Input& input);

 private:
  const Gl* gl_;
  Program program_;
  GlVertexArray array_;
  GlBuffer buffer_;
  GlTexture font_texture_;
  std::unique_ptr<ImFontAtlas, void (*)(ImFontAtlas*)> font_;
};

// The user interface's triangles.
class UiPass {
 public:
  UiPass(const Gl& gl, const std::string& shaders);
  // The fonts are those of the current ImGui context; texture id 0 stands for their atlas.
  void draw(const ImDrawData& data, int width, int height);

 private:
  void uploadFonts();
  void drawList(const ImDrawList& list, const ImDrawData& data, int height) const;
  const Gl* gl_;
  Program program_;
  GlVertexArray array_;
  GlBuffer vertices_, indices_;
  GlTexture font_texture_;
};

}  // namespace viewer
