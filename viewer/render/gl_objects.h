// GL objects that free themselves. Each remembers the function table of its context.
#pragma once

#include <glad/gl.h>

#include <utility>

namespace viewer {

using Gl = GladGLContext;

// Traits: static GLuint make(const Gl&), static void free(const Gl&, GLuint).
template <class Traits>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(const Gl& gl) : gl_(&gl), id_(Traits::make(gl)) {}
  ~GlObject() { reset(); }
  GlObject(GlObject&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    return *this;
  }

  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  void reset() {
    if (id_) Traits::free(*gl_, id_);
    id_ = 0;
  }
  const Gl* gl_ = nullptr;
  GLuint id_ = 0;
};

namespace traits {

struct Buffer {
  static GLuint make(const Gl& gl) {
    GLuint id = 0;
    gl.GenBuffers(1, &id);
    return id;
  }
  static void free(const Gl& gl, GLuint id) { gl.DeleteBuffers(1, &id); }
};
struct VertexArray {
  static GLuint make(const Gl& gl) {
    GLuint id = 0;
    gl.GenVertexArrays(1, &id);
    return id;
  }
  static void free(const Gl& gl, GLuint id) { gl.DeleteVertexArrays(1, &id); }
};
struct Texture {
  static GLuint make(const Gl& gl) {
    GLuint id = 0;
    gl.GenTextures(1, &id);
    return id;
  }
  static void free(const Gl& gl, GLuint id) { gl.DeleteTextures(1, &id); }
};
struct Framebuffer {
  static GLuint make(const Gl& gl) {
    GLuint id = 0;
    gl.GenFramebuffers(1, &id);
    return id;
  }
  static void free(const Gl& gl, GLuint id) { gl.DeleteFramebuffers(1, &id); }
};
struct Program {
  static GLuint make(const Gl& gl) { return gl.CreateProgram(); }
  static void free(const Gl& gl, GLuint id) { gl.DeleteProgram(id); }
};

}  // namespace traits

using GlBuffer = GlObject<traits::Buffer>;
using GlVertexArray = GlObject<traits::VertexArray>;
using GlTexture = GlObject<traits::Texture>;
using GlFramebuffer = GlObject<traits::Framebuffer>;

}  // namespace viewer
