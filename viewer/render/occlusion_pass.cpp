// Ambient occlusion from the depth buffer, for pictures with time to spare.
#include "viewer/render/passes.h"

namespace viewer {

OcclusionPass::OcclusionPass(const Gl& gl, const std::string& shaders)
    : gl_(&gl),
      estimate_(gl, {"fullscreen.vert.glsl", "occlusion.frag.glsl", {}, shaders}),
      blur_(gl, {"fullscreen.vert.glsl", "occlusion_blur.frag.glsl", {}, shaders}),
      array_(gl) {}

void OcclusionPass::draw(const Target& scene, const FrameBlock& frame, float radius_m) {
  const int width = (scene.width() + 1) / 2, height = (scene.height() + 1) / 2;
  if (occlusion_.width() != width || occlusion_.height() != height)
    occlusion_ = Target(*gl_, width, height, {.color = GL_R8});
  gl_->BindVertexArray(array_.id());

  occlusion_.bind();
  apply(*gl_, {});
  estimate_.use();
  estimate_.bind("t_depth", 0, scene.depth());
  const Mat4 world_from_clip = frame.clip_from_world.inverse();
  estimate_.set("u_world_from_clip", world_from_clip);
  estimate_.set("u_radius", radius_m);
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);

  scene.bindColorOnly();
  apply(*gl_, {.blend = Blend::Multiply});
  blur_.use();
  blur_.bind("t_open", 0, occlusion_.color());
  blur_.bind("t_depth", 1, scene.depth());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindVertexArray(0);
}

}  // namespace viewer
