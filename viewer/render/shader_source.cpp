#include "viewer/render/shader_source.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "viewer/render/renderer.h"

namespace viewer {

namespace {

std::string plainText(std::string_view name, const std::string& dir) {
  if (!dir.empty()) {
    const std::string path = dir + "/" + std::string(name);
    std::ifstream file(path);
    if (!file) throw RenderError("cannot read the shader " + path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  const auto all = embeddedShaders();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const EmbeddedShader& s) { return s.name == name; });
  if (found == all.end()) throw RenderError("there is no shader " + std::string(name));
  return std::string(found->text);
}

}  // namespace

std::string shaderSource(std::string_view name, const std::string& dir) {
  constexpr std::string_view kInclude = "#include \"";
  std::istringstream lines(plainText(name, dir));
  std::string text, line;
  while (std::getline(lines, line)) {
    if (line.starts_with(kInclude))
      text += shaderSource(line.substr(kInclude.size(), line.rfind('"') - kInclude.size()), dir);
    else
      text += line + "\n";
  }
  return text;
}

}  // namespace viewer
