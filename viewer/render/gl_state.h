// The fixed-function state of a pass, set as a whole, so that no pass depends on the one before it.
#pragma once

#include <optional>

#include "viewer/render/gl_objects.h"

namespace viewer {

// Samples, from the lower left corner of the picture.
struct ScreenRect {
  int x = 0, y = 0, width = 0, height = 0;
};

enum class Depth { Off, Test, TestAndWrite, Hidden };  // Hidden: passes what lies behind
enum class Cull { None, Back, Front };
enum class Blend { Off, Alpha, Multiply };

struct GlState {
  Depth depth = Depth::Off;
  Cull cull = Cull::None;
  Blend blend = Blend::Off;
  bool color = true;
  std::optional<ScreenRect> inside = {};  // nothing is drawn outside of it
};

inline void apply(const Gl& gl, const GlState& s) {
  const auto toggle = [&](GLenum what, bool on) { on ? gl.Enable(what) : gl.Disable(what); };
  toggle(GL_DEPTH_TEST, s.depth != Depth::Off);
  gl.DepthMask(s.depth == Depth::TestAndWrite ? GL_TRUE : GL_FALSE);
  gl.DepthFunc(s.depth == Depth::Hidden ? GL_GREATER : GL_LEQUAL);
  toggle(GL_CULL_FACE, s.cull != Cull::None);
  gl.CullFace(s.cull == Cull::Front ? GL_FRONT : GL_BACK);
  toggle(GL_BLEND, s.blend != Blend::Off);
  if (s.blend == Blend::Multiply)
    gl.BlendFunc(GL_DST_COLOR, GL_ZERO);
  else
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const GLboolean color = s.color ? GL_TRUE : GL_FALSE;
  gl.ColorMask(color, color, color, color);
  toggle(GL_SCISSOR_TEST, s.inside.has_value());
  if (s.inside) gl.Scissor(s.inside->x, s.inside->y, s.inside->width, s.inside->height);
}

}  // namespace viewer
