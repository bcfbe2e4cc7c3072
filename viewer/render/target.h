// A framebuffer of our own: colour and depth textures of one size.
#pragma once

#include "viewer/render/gl_objects.h"

namespace viewer {

struct TargetFormat {
  GLenum color = 0;      // GL_RGBA8, GL_R32UI, GL_R8 or 0: none
  bool depth = false;    // 32-bit float
  bool compare = false;  // depth is looked up by comparison with linear filtering
};

class Target {
 public:
  Target() = default;
  Target(const Gl& gl, int width, int height, const TargetFormat& format);  // throws RenderError

  // Makes it the target of drawing, with a viewport over all of it.
  void bind() const;
  // The same without depth, for passes that read this target's depth.
  void bindColorOnly() const;
  GLuint framebuffer() const { return framebuffer_.id(); }
  GLuint color() const { return color_.id(); }
  GLuint depth() const { return depth_.id(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  const Gl* gl_ = nullptr;
  int width_ = 0, height_ = 0;
  GlFramebuffer framebuffer_, color_only_;
  GlTexture color_, depth_;
};

}  // namespace viewer
