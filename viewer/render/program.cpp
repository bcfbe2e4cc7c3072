#include "viewer/render/program.h"

#include <array>

#include "viewer/render/renderer.h"
#include "viewer/render/shader_source.h"

namespace viewer {

namespace {

GLuint compile(const Gl& gl, GLenum stage, const std::string& file, const ProgramSource& source) {
  std::string text = "#version 330 core\n";
  for (const std::string& name : source.defines) text += "#define " + name + "\n";
  text += shaderSource(file, source.dir);
  const GLuint shader = gl.CreateShader(stage);
  const char* chars = text.c_str();
  gl.ShaderSource(shader, 1, &chars, nullptr);
  gl.CompileShader(shader);
  GLint ok = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok) return shader;
  std::array<char, 2048> log{};
  gl.GetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
  gl.DeleteShader(shader);
  throw RenderError("shader " + file + ": " + log.data());
}

}  // namespace

Program::Program(const Gl& gl, const ProgramSource& source) : gl_(&gl), object_(gl) {
  const GLuint vertex = compile(gl, GL_VERTEX_SHADER, source.vertex, source);
  const GLuint fragment = compile(gl, GL_FRAGMENT_SHADER, source.fragment, source);
  const GLuint id = object_.id();
  gl.AttachShader(id, vertex);
  gl.AttachShader(id, fragment);
  gl.LinkProgram(id);
  gl.DeleteShader(vertex);
  gl.DeleteShader(fragment);
  GLint ok = GL_FALSE;
  gl.GetProgramiv(id, GL_LINK_STATUS, &ok);
  if (!ok) {
    std::array<char, 2048> log{};
    gl.GetProgramInfoLog(id, GLsizei(log.size()), nullptr, log.data());
    throw RenderError("linking " + source.vertex + " and " + source.fragment + ": " + log.data());
  }
  const GLuint block = gl.GetUniformBlockIndex(id, "Frame");
  if (block != GL_INVALID_INDEX) gl.UniformBlockBinding(id, block, 0);
}

void Program::bind(const char* name, int unit, GLuint texture) const {
  gl_->ActiveTexture(GLenum(GL_TEXTURE0 + unit));
  gl_->BindTexture(GL_TEXTURE_2D, texture);
  set(name, unit);
}

}  // namespace viewer
