#include "viewer/render/target.h"

#include <string>

#include "viewer/render/renderer.h"

namespace viewer {

namespace {

struct TextureSpec {
  GLenum internal, format, type, filter;
};

TextureSpec colorSpec(GLenum color) {
  switch (color) {
    case GL_R32UI:
      return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, GL_NEAREST};
    case GL_R8:
      return {GL_R8, GL_RED, GL_UNSIGNED_BYTE, GL_LINEAR};
    default:
      return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GL_NEAREST};
  }
}

GlTexture makeTexture(const Gl& gl, int width, int height, const TextureSpec& spec) {
  GlTexture texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.id());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GLint(spec.internal), width, height, 0, spec.format, spec.type, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GLint(spec.filter));
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GLint(spec.filter));
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

Target::Target(const Gl& gl, int width, int height, const TargetFormat& format)
    : gl_(&gl), width_(width), height_(height), framebuffer_(gl) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  if (format.color) {
    color_ = makeTexture(gl, width, height, colorSpec(format.color));
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
  } else {
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
  }
  if (format.depth) {
    const GLenum filter = format.compare ? GL_LINEAR : GL_NEAREST;
    depth_ = makeTexture(gl, width, height, {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, filter});
    if (format.compare) {
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
  }
  if (format.color && format.depth) {
    color_only_ = GlFramebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, color_only_.id());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  }
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw RenderError("no framebuffer of " + std::to_string(width) + " x " + std::to_string(height) + " px");
}

void Target::bind() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  gl_->Viewport(0, 0, width_, height_);
}

void Target::bindColorOnly() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, color_only_.id());
  gl_->Viewport(0, 0, width_, height_);
}

}  // namespace viewer
