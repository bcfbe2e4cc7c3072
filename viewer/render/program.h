// A linked shader program and its uniforms.
#pragma once

#include <string>
#include <vector>

#include "viewer/draw_list/camera.h"
#include "viewer/render/gl_objects.h"

namespace viewer {

struct ProgramSource {
  std::string vertex, fragment;  // file names in shaders/
  std::vector<std::string> defines;
  std::string dir;  // of the shaders, or empty: built in
};

class Program {
 public:
  // Compiles and links; block Frame is bound to point 0. Throws RenderError with the compiler's message.
  Program(const Gl& gl, const ProgramSource& source);

  void use() const { gl_->UseProgram(object_.id()); }
  // Setters act on the program in use. Names that the compiler removed are ignored.
  void set(const char* name, int value) const { gl_->Uniform1i(location(name), value); }
  void set(const char* name, uint32_t value) const { gl_->Uniform1ui(location(name), value); }
  void set(const char* name, float value) const { gl_->Uniform1f(location(name), value); }
  void set(const char* name, float x, float y) const { gl_->Uniform2f(location(name), x, y); }
  void set(const char* name, const Eigen::Vector4f& v) const { gl_->Uniform4fv(location(name), 1, v.data()); }
  void set(const char* name, const Mat4& m) const {
    gl_->UniformMatrix4fv(location(name), 1, GL_FALSE, m.data());
  }
  // Binds a texture to a unit and tells the sampler of that name.
  void bind(const char* name, int unit, GLuint texture) const;

 private:
  GLint location(const char* name) const { return gl_->GetUniformLocation(object_.id(), name); }
  const Gl* gl_;
  GlObject<traits::Program> object_;
};

}  // namespace viewer
