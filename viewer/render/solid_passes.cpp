// Shadow map, lit solids and pick ids: the three passes that draw the instances of the solid store.
#include "viewer/render/passes.h"

namespace viewer {

namespace {

enum class Layer : int { Opaque = 0, Translucent = 1, All = 2 };

struct Eye {
  Mat4 clip;
  Eigen::Vector4f rays;  // eye with 1, or direction of all rays with 0
  Layer layer;
};

// Triangles with one program, round things with the other. Triangles show their front; of the boxes round
// spheres and capsules the back is drawn, which is there even when the eye is inside.
void drawSolids(const Gl& gl, std::span<const SolidDraw> draws, const Program& triangles,
                const Program& round, GlState state, const Eye& eye) {
  for (const bool want_round : {false, true}) {
    const Program& program = want_round ? round : triangles;
    program.use();
    program.set("u_clip", eye.clip);
    program.set("u_eye", eye.rays);
    state.cull = want_round ? Cull::Front : Cull::Back;
    apply(gl, state);
    for (const SolidDraw& d : draws) {
      if (d.round != want_round) continue;
      // A batch without translucent instances needs no sorting out in the shader.
      program.set("u_layer", int(eye.layer == Layer::Opaque && !d.translucent ? Layer::All : eye.layer));
      gl.BindVertexArray(d.vertex_array);
      gl.DrawArraysInstanced(GL_TRIANGLES, 0, d.vertices, d.instances);
    }
  }
  gl.BindVertexArray(0);
}

Eigen::Vector4f raysOf(const FrameBlock& f) { return f.eye.w() > 0.5f ? f.eye : f.ray_forward; }

}  // namespace

ShadowPass::ShadowPass(const Gl& gl, const std::string& shaders, int map_size)
    : gl_(&gl),
      triangles_(gl, {"solid_plain.vert.glsl", "solid_plain.frag.glsl", "PASS_DEPTH", shaders}),
      round_(gl, {"round.vert.glsl", "round.frag.glsl", "PASS_DEPTH", shaders}),
      target_(gl, map_size, map_size, {.color = 0, .depth = true, .compare = true}) {}

void ShadowPass::draw(std::span<const SolidDraw> draws, const SunView& sun) const {
  target_.bind();
  apply(*gl_, {.depth = Depth::TestAndWrite});
  gl_->ClearDepth(1.0);
  gl_->Clear(GL_DEPTH_BUFFER_BIT);
  if (sun.empty) return;
  const Eigen::Vector4f rays(-sun.to_sun.x(), -sun.to_sun.y(), -sun.to_sun.z(), 0.0f);
  drawSolids(*gl_, draws, triangles_, round_, {.depth = Depth::TestAndWrite, .color = false},
             {sun.clip_from_world, rays, Layer::Opaque});
}

SolidPass::SolidPass(const Gl& gl, const std::string& shaders)
    : gl_(&gl),
      triangles_(gl, {"solid.vert.glsl", "solid.frag.glsl", "PASS_COLOR", shaders}),
      round_(gl, {"round.vert.glsl", "round.frag.glsl", "PASS_COLOR", shaders}) {}

void SolidPass::draw(std::span<const SolidDraw> draws, const Input& input) const {
  if (draws.empty()) return;
  for (const Program* program : {&triangles_, &round_}) {
    program->use();
    program->bind("t_shadow", 0, input.shadow_map);
    program->set("u_wire", input.wire);
  }
  const GlState opaque = {.depth = Depth::TestAndWrite};
  const GlState through = {.depth = Depth::Test, .blend = Blend::Alpha};
  drawSolids(*gl_, draws, triangles_, round_, input.translucent ? through : opaque,
             {input.frame->clip_from_world, raysOf(*input.frame),
              input.translucent ? Layer::Translucent : Layer::Opaque});
}

IdPass::IdPass(const Gl& gl, const std::string& shaders)
    : gl_(&gl),
      triangles_(gl, {"solid_plain.vert.glsl", "solid_plain.frag.glsl", "PASS_ID", shaders}),
      round_(gl, {"round.vert.glsl", "round.frag.glsl", "PASS_ID", shaders}) {}

void IdPass::draw(std::span<const SolidDraw> draws, const FrameBlock& frame) const {
  drawSolids(*gl_, draws, triangles_, round_, {.depth = Depth::TestAndWrite},
             {frame.clip_from_world, raysOf(frame), Layer::All});
}

}  // namespace viewer
