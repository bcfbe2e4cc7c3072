// The text of the shaders: built in, or read from a folder while they are being worked on.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace viewer {

struct EmbeddedShader {
  std::string_view name, text;
};
std::span<const EmbeddedShader> embeddedShaders();  // generated from shaders/*.glsl

// Text of a shader with its #include "..." lines replaced, from `dir` or, when that is empty, the built-in
// one. Throws RenderError naming what is missing.
std::string shaderSource(std::string_view name, const std::string& dir);

}  // namespace viewer
