// Lines, arrows and points as quads that face the screen: the stock primitives of GL differ between
// rasterisers.
#include "viewer/render/passes.h"

namespace viewer {

namespace {

// The vertex buffer's record. Kinds are those of overlay.vert.glsl.
struct Segment {
  pfx::Vec3 from, to;
  Color color;
  float width;
  uint32_t kind;
  uint32_t pick;
};
static_assert(sizeof(Segment) == 40);
constexpr uint32_t kLine = 0, kShaft = 1, kHead = 2, kPoint = 3;

constexpr float kHiddenStrength = 0.22f;

std::vector<Segment> segmentsOf(const DrawList& list) {
  std::vector<Segment> s;
  s.reserve(list.lines().size() + 2 * list.arrows().size() + list.points().size());
  for (const Line& l : list.lines()) s.push_back({l.from, l.to, l.color, l.width, kLine, l.pick});
  for (const Arrow& a : list.arrows()) {
    s.push_back({a.from, a.to, a.color, a.width, kShaft, a.pick});
    s.push_back({a.from, a.to, a.color, a.width, kHead, a.pick});
  }
  for (const Point& p : list.points()) s.push_back({p.position, p.position, p.color, p.size, kPoint, p.pick});
  return s;
}

}  // namespace

OverlayPass::OverlayPass(const Gl& gl, const std::string& shaders)
    : gl_(&gl),
      color_(gl, {"overlay.vert.glsl", "overlay.frag.glsl", {"PASS_COLOR"}, shaders}),
      ids_(gl, {"overlay.vert.glsl", "overlay.frag.glsl", {"PASS_ID"}, shaders}),
      array_(gl),
      buffer_(gl) {
  gl.BindVertexArray(array_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  const auto at = [](size_t offset) { return reinterpret_cast<const void*>(offset); };
  constexpr GLsizei kStride = sizeof(Segment);
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Segment, from)));
  gl.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Segment, to)));
  gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride, at(offsetof(Segment, color)));
  gl.VertexAttribPointer(3, 1, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Segment, width)));
  gl.VertexAttribIPointer(4, 1, GL_UNSIGNED_INT, kStride, at(offsetof(Segment, kind)));
  gl.VertexAttribIPointer(5, 1, GL_UNSIGNED_INT, kStride, at(offsetof(Segment, pick)));
  for (GLuint i = 0; i < 6; ++i) {
    gl.EnableVertexAttribArray(i);
    gl.VertexAttribDivisor(i, 1);
  }
  gl.BindVertexArray(0);
}

size_t OverlayPass::update(const DrawList& list) {
  const std::vector<Segment> segments = segmentsOf(list);
  count_ = segments.size();
  if (segments.empty()) return 0;
  const size_t bytes = segments.size() * sizeof(Segment);
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, GLsizeiptr(bytes), segments.data(), GL_STREAM_DRAW);
  return bytes;
}

void OverlayPass::drawQuads(const Program& program, int width, int height, int side) const {
  program.set("u_pixels", float(width), float(height));
  program.set("u_side", float(side));
  gl_->BindVertexArray(array_.id());
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(count_));
  gl_->BindVertexArray(0);
}

void OverlayPass::draw(int width, int height, int side) const {
  if (count_ == 0) return;
  color_.use();
  apply(*gl_, {.depth = Depth::Hidden, .blend = Blend::Alpha});
  color_.set("u_strength", kHiddenStrength);
  drawQuads(color_, width, height, side);
  apply(*gl_, {.depth = Depth::Test, .blend = Blend::Alpha});
  color_.set("u_strength", 1.0f);
  drawQuads(color_, width, height, side);
}

void OverlayPass::drawIds(int width, int height) const {
  if (count_ == 0) return;
  ids_.use();
  apply(*gl_, {.depth = Depth::Test});
  drawQuads(ids_, width, height, 1);
}

}  // namespace viewer
