// Shadow map, lit solids and pick ids: the passes that draw the instances of the solid store.
#include "viewer/render/passes.h"

namespace viewer {

namespace {

constexpr uint32_t kPlain = uint32_t(Layer::Plain), kShiny = uint32_t(Layer::Shiny),
                   kFloor = uint32_t(Layer::Floor), kTranslucent = uint32_t(Layer::Translucent),
                   kAll = kPlain | kShiny | kFloor | kTranslucent;

struct Eye {
  Mat4 clip;
  Eigen::Vector4f rays;  // eye with 1, or direction of all rays with 0
};

Eye eyeOf(const FrameBlock& f) { return {f.clip_from_world, f.eye.w() > 0.5f ? f.eye : f.ray_forward}; }

// Draws one kind of solid (round or of triangles) in some layers. Triangles show their front; of the boxes
// round spheres and capsules the back is drawn, which is there even when the eye is inside.
struct SolidPrograms {
  const Gl& gl;
  GlState state;
  Eye eye;

  void draw(std::span<const SolidDraw> draws, const Program& program, bool round, uint32_t layers) {
    program.use();
    program.set("u_clip", eye.clip);
    program.set("u_eye", eye.rays);
    program.set("u_layers", layers);
    state.cull = round ? Cull::Front : Cull::Back;
    apply(gl, state);
    for (const SolidDraw& d : draws) {
      if (d.round != round || !(d.layers & layers)) continue;
      gl.BindVertexArray(d.vertex_array);
      gl.DrawArraysInstanced(GL_TRIANGLES, 0, d.vertices, d.instances);
    }
    gl.BindVertexArray(0);
  }
};

std::vector<std::string> defines(std::initializer_list<const char*> names,
                                 const SolidPass::Options& options) {
  std::vector<std::string> all(names.begin(), names.end());
  if (options.wide_shadow) all.push_back("WIDE_SHADOW");
  if (options.wire) all.push_back("WIRE");
  return all;
}

}  // namespace

ShadowPass::ShadowPass(const Gl& gl, const std::string& shaders, int map_size)
    : gl_(&gl),
      triangles_(gl, {"solid_plain.vert.glsl", "solid_plain.frag.glsl", {"PASS_DEPTH"}, shaders}),
      round_(gl, {"round.vert.glsl", "round.frag.glsl", {"PASS_DEPTH"}, shaders}),
      target_(gl, map_size, map_size, {.color = 0, .depth = true, .compare = true}) {}

void ShadowPass::draw(std::span<const SolidDraw> draws, const SunView& sun) const {
  target_.bind();
  apply(*gl_, {.depth = Depth::TestAndWrite});
  gl_->ClearDepth(1.0);
  gl_->Clear(GL_DEPTH_BUFFER_BIT);
  if (sun.empty) return;
  const Eigen::Vector4f rays(-sun.to_sun.x(), -sun.to_sun.y(), -sun.to_sun.z(), 0.0f);
  SolidPrograms pass{*gl_, {.depth = Depth::TestAndWrite, .color = false}, {sun.clip_from_world, rays}};
  pass.draw(draws, triangles_, false, kPlain | kShiny);
  pass.draw(draws, round_, true, kPlain | kShiny);
}

SolidPass::SolidPass(const Gl& gl, const std::string& shaders, const Options& options)
    : gl_(&gl),
      depth_(gl, {"solid_plain.vert.glsl", "solid_plain.frag.glsl", {"PASS_DEPTH"}, shaders}),
      plain_(gl, {"solid.vert.glsl", "solid.frag.glsl", defines({}, options), shaders}),
      shiny_(gl, {"solid.vert.glsl", "solid.frag.glsl", defines({"SHINY"}, options), shaders}),
      floor_(gl, {"solid.vert.glsl", "floor.frag.glsl", defines({}, options), shaders}),
      plain_round_(gl, {"round.vert.glsl", "round.frag.glsl", defines({"PASS_COLOR"}, options), shaders}),
      shiny_round_(
          gl, {"round.vert.glsl", "round.frag.glsl", defines({"PASS_COLOR", "SHINY"}, options), shaders}) {}

void SolidPass::useShadow(GLuint shadow_map) const {
  for (const Program* program : {&plain_, &shiny_, &floor_, &plain_round_, &shiny_round_}) {
    program->use();
    program->bind("t_shadow", 0, shadow_map);
  }
}

void SolidPass::draw(std::span<const SolidDraw> draws, const FrameBlock& frame, GLuint shadow_map) const {
  SolidPrograms first{*gl_, {.depth = Depth::TestAndWrite, .color = false}, eyeOf(frame)};
  first.draw(draws, depth_, false, kPlain | kShiny);
  useShadow(shadow_map);
  SolidPrograms pass{*gl_, {.depth = Depth::TestAndWrite}, eyeOf(frame)};
  pass.draw(draws, plain_, false, kPlain);
  pass.draw(draws, shiny_, false, kShiny);
  pass.draw(draws, plain_round_, true, kPlain);
  pass.draw(draws, shiny_round_, true, kShiny);
  // Last, since most of a floor is behind something or alone: little is shaded twice.
  pass.draw(draws, floor_, false, kFloor);
}

void SolidPass::drawTranslucent(std::span<const SolidDraw> draws, const FrameBlock& frame,
                                GLuint shadow_map) const {
  if (draws.empty()) return;
  useShadow(shadow_map);
  SolidPrograms pass{*gl_, {.depth = Depth::Test, .blend = Blend::Alpha}, eyeOf(frame)};
  for (const SolidDraw& d : draws) pass.draw({&d, 1}, d.round ? shiny_round_ : shiny_, d.round, kTranslucent);
}

IdPass::IdPass(const Gl& gl, const std::string& shaders)
    : gl_(&gl),
      triangles_(gl, {"solid_plain.vert.glsl", "solid_plain.frag.glsl", {"PASS_ID"}, shaders}),
      round_(gl, {"round.vert.glsl", "round.frag.glsl", {"PASS_ID"}, shaders}) {}

void IdPass::draw(std::span<const SolidDraw> draws, const FrameBlock& frame) const {
  SolidPrograms pass{*gl_, {.depth = Depth::TestAndWrite}, eyeOf(frame)};
  pass.draw(draws, triangles_, false, kAll);
  pass.draw(draws, round_, true, kAll);
}

}  // namespace viewer
