// The passes that cover the whole picture with one triangle: sky, resolve, outline.
#include "viewer/render/passes.h"

namespace viewer {

SkyPass::SkyPass(const Gl& gl, const std::string& shaders)
    : gl_(&gl), program_(gl, {"fullscreen.vert.glsl", "sky.frag.glsl", {}, shaders}), array_(gl) {}

void SkyPass::draw() const {
  // The triangle lies on the far plane: it passes only where nothing nearer was drawn.
  apply(*gl_, {.depth = Depth::Test});
  program_.use();
  gl_->BindVertexArray(array_.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

ResolvePass::ResolvePass(const Gl& gl, const std::string& shaders)
    : gl_(&gl), program_(gl, {"fullscreen.vert.glsl", "resolve.frag.glsl", {}, shaders}), array_(gl) {}

void ResolvePass::draw(GLuint samples, int side) const {
  apply(*gl_, {});
  program_.use();
  program_.bind("t_samples", 0, samples);
  program_.set("u_side", side);
  gl_->BindVertexArray(array_.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

OutlinePass::OutlinePass(const Gl& gl, const std::string& shaders)
    : gl_(&gl), program_(gl, {"fullscreen.vert.glsl", "outline.frag.glsl", {}, shaders}), array_(gl) {}

void OutlinePass::draw(GLuint ids, uint32_t selected) const {
  apply(*gl_, {.blend = Blend::Alpha});
  program_.use();
  program_.bind("t_ids", 0, ids);
  program_.set("u_selected", selected);
  gl_->BindVertexArray(array_.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace viewer
