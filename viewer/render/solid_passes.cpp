// Shadow map, lit solids and pick ids: the passes that draw the instances of the solid store.
#include <algorithm>
#include <iterator>

#include "viewer/render/passes.h"
#include "viewer/render/visible_runs.h"

namespace viewer {

namespace {

// Layers of a pass.
using Layers = std::initializer_list<Layer>;
constexpr Layers kOpaque = {Layer::Plain, Layer::Shiny};
constexpr Layers kAll = {Layer::Plain, Layer::Shiny, Layer::Floor, Layer::Translucent};

struct Eye {
  Mat4 clip;
  Eigen::Vector4f rays;  // eye with 1, or direction of all rays with 0
};

Eye eyeOf(const FrameBlock& f) { return {f.clip_from_world, f.eye.w() > 0.5f ? f.eye : f.ray_forward}; }

// What a program reads of a vertex.
enum class Attributes { All, Position };

struct SolidProgram {
  const Program& program;
  bool round;  // spheres and capsules; else triangles
  Attributes attributes;
};

// Draws one kind of solid (round or of triangles) in some layers. Triangles show their front; of the boxes
// round spheres and capsules the back is drawn, which is there even when the eye is inside.
struct SolidDrawing {
  const Gl& gl;
  GlState state;
  Eye eye;
  Frustum frustum = Frustum(eye.clip);

  void start(const SolidProgram& with) {
    with.program.use();
    with.program.set("u_clip", eye.clip);
    with.program.set("u_eye", eye.rays);
    state.cull = with.round ? Cull::Front : Cull::Back;
    apply(gl, state);
  }

  void draw(std::span<const SolidDraw> draws, const SolidProgram& with, Layers layers) {
    start(with);
    for (const SolidDraw& d : draws)
      if (d.round == with.round && std::find(layers.begin(), layers.end(), d.layer) != layers.end())
        drawVisible(d, with.attributes);
    gl.BindVertexArray(0);
  }

  void drawVisible(const SolidDraw& d, Attributes attributes) const {
    gl.BindVertexArray(attributes == Attributes::All ? d.shaded : d.bare);
    size_t pointed_to = 0;
    const auto pointTo = [&](size_t first) {
      if (first != pointed_to) pointToInstances(gl, d.instance_buffer, first);
      pointed_to = first;
    };
    forVisibleRuns(frustum, d.block_bounds, size_t(d.instances), [&](size_t first, size_t count) {
      pointTo(first);
      if (attributes == Attributes::All)
        gl.DrawArraysInstanced(GL_TRIANGLES, 0, d.vertices, GLsizei(count));
      else
        gl.DrawElementsInstanced(GL_TRIANGLES, d.vertices, GL_UNSIGNED_INT, nullptr, GLsizei(count));
    });
    pointTo(0);
  }
};

SolidProgram triangles(const Program& program, Attributes attributes) { return {program, false, attributes}; }
// The box round a ball needs no more than its corners.
SolidProgram rounds(const Program& program) { return {program, true, Attributes::Position}; }

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
  SolidDrawing pass{*gl_, {.depth = Depth::TestAndWrite, .color = false}, {sun.clip_from_world, rays}};
  pass.draw(draws, triangles(triangles_, Attributes::Position), kOpaque);
  pass.draw(draws, rounds(round_), kOpaque);
}

SolidPass::SolidPass(const Gl& gl, const std::string& shaders, const Options& options)
    : gl_(&gl),
      depth_(gl, {"solid_plain.vert.glsl", "solid_plain.frag.glsl", {"PASS_DEPTH"}, shaders}),
      plain_(gl, {"solid.vert.glsl", "solid.frag.glsl", defines({}, options), shaders}),
      shiny_(gl, {"solid.vert.glsl", "solid.frag.glsl", defines({"SHINY"}, options), shaders}),
      floor_(gl, {"solid.vert.glsl", "floor.frag.glsl", defines({}, options), shaders}),
      sunny_floor_(gl, {"solid.vert.glsl", "floor.frag.glsl", defines({"NO_SHADOW"}, options), shaders}),
      plain_round_(gl, {"round.vert.glsl", "round.frag.glsl", defines({"PASS_COLOR"}, options), shaders}),
      shiny_round_(
          gl, {"round.vert.glsl", "round.frag.glsl", defines({"PASS_COLOR", "SHINY"}, options), shaders}) {}

void SolidPass::useShadow(GLuint shadow_map) const {
  for (const Program* program : {&plain_, &shiny_, &floor_, &plain_round_, &shiny_round_}) {
    program->use();
    program->bind("t_shadow", 0, shadow_map);
  }
}

// Depth first, so that what is hidden is not shaded. A mesh of many triangles hides little of itself: setting up its
// triangles twice would cost more than it saves.
void SolidPass::drawDepth(std::span<const SolidDraw> draws, const FrameBlock& frame) const {
  constexpr GLsizei kManyVertices = 6000;
  std::vector<SolidDraw> simple;
  std::copy_if(draws.begin(), draws.end(), std::back_inserter(simple),
               [](const SolidDraw& d) { return d.vertices <= kManyVertices; });
  SolidDrawing pass{*gl_, {.depth = Depth::TestAndWrite, .color = false}, eyeOf(frame)};
  pass.draw(simple, triangles(depth_, Attributes::Position), kOpaque);
}

void SolidPass::drawFloors(std::span<const SolidDraw> draws, const FrameBlock& frame, const ScreenRect& reach) const {
  const auto drawInside = [&](const ScreenRect& rect, const Program& program) {
    if (rect.width <= 0 || rect.height <= 0) return;
    SolidDrawing pass{*gl_, {.depth = Depth::TestAndWrite, .inside = rect}, eyeOf(frame)};
    pass.draw(draws, triangles(program, Attributes::All), {Layer::Floor});
  };
  drawInside(reach, floor_);
  for (const ScreenRect& rect : around(reach, frame)) drawInside(rect, sunny_floor_);
}

void SolidPass::draw(std::span<const SolidDraw> draws, const FrameBlock& frame, const Shadow& shadow) const {
  drawDepth(draws, frame);
  useShadow(shadow.map);
  SolidDrawing pass{*gl_, {.depth = Depth::TestAndWrite}, eyeOf(frame)};
  pass.draw(draws, triangles(plain_, Attributes::All), {Layer::Plain});
  pass.draw(draws, triangles(shiny_, Attributes::All), {Layer::Shiny});
  pass.draw(draws, rounds(plain_round_), {Layer::Plain});
  pass.draw(draws, rounds(shiny_round_), {Layer::Shiny});
  // Last, since most of a floor is behind something or alone: little is shaded twice.
  drawFloors(draws, frame, shadow.reach);
}

void SolidPass::drawTranslucent(std::span<const SolidDraw> draws, const FrameBlock& frame,
                                GLuint shadow_map) const {
  if (draws.empty()) return;
  useShadow(shadow_map);
  SolidDrawing pass{*gl_, {.depth = Depth::Test, .blend = Blend::Alpha}, eyeOf(frame)};
  for (const SolidDraw& d : draws)
    pass.draw({&d, 1}, d.round ? rounds(shiny_round_) : triangles(shiny_, Attributes::All), {Layer::Translucent});
}

IdPass::IdPass(const Gl& gl, const std::string& shaders)
    : gl_(&gl),
      triangles_(gl, {"solid_plain.vert.glsl", "solid_plain.frag.glsl", {"PASS_ID"}, shaders}),
      round_(gl, {"round.vert.glsl", "round.frag.glsl", {"PASS_ID"}, shaders}) {}

void IdPass::draw(std::span<const SolidDraw> draws, const FrameBlock& frame) const {
  SolidDrawing pass{*gl_, {.depth = Depth::TestAndWrite}, eyeOf(frame)};
  pass.draw(draws, triangles(triangles_, Attributes::Position), kAll);
  pass.draw(draws, rounds(round_), kAll);
}

}  // namespace viewer
