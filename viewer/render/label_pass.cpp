// Labels, legend and scale bar: text from ImGui's built-in font, laid out in whole pixels.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/render/label_places.h"
#include "viewer/render/passes.h"

namespace viewer {

namespace {

struct Glyph {
  float x, y, u, v;
  Color color;
  pfx::Vec3 anchor;  // as in label.vert.glsl
};
static_assert(sizeof(Glyph) == 32);

const pfx::Vec3 kNeverHidden(0.0f, 0.0f, -1.0f);

struct Point2 {
  float x, y;  // px
};

// Collects quads of text. Positions are pixels from the top left corner.
class TextLayout {
 public:
  TextLayout(const ImFont& font, float scale) : font_(font), scale_(scale) {}

  float width(const std::string& text) const {
    float w = 0.0f;
    for (const char c : text) w += advance(c);
    return w * scale_;
  }
  float height() const { return font_.FontSize * scale_; }

  void text(float x, float y, const std::string& text, Color color, const pfx::Vec3& anchor) {
    x = std::round(x), y = std::round(y);
    // One pixel more on each side for the halo.
    for (const char c : text) {
      const ImFontGlyph* g = glyph(c);
      if (g && g->Visible) {
        const float du = 1.0f / float(font_.ContainerAtlas->TexWidth),
                    dv = 1.0f / float(font_.ContainerAtlas->TexHeight);
        quad({x + (g->X0 - 1) * scale_, y + (g->Y0 - 1) * scale_, x + (g->X1 + 1) * scale_,
              y + (g->Y1 + 1) * scale_},
             {g->U0 - du, g->V0 - dv, g->U1 + du, g->V1 + dv}, color, anchor);
      }
      x += advance(c) * scale_;
    }
  }

  // A line of one pixel.
  void line(const Point2& from, const Point2& to, Color color, const pfx::Vec3& anchor) {
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length > 0.0f)) return;
    const float x = -0.5f * scale_ * (to.y - from.y) / length, y = 0.5f * scale_ * (to.x - from.x) / length;
    const ImVec2 white = font_.ContainerAtlas->TexUvWhitePixel;
    const auto corner = [&](float px, float py) { return Glyph{px, py, white.x, white.y, color, anchor}; };
    const Glyph a = corner(from.x - x, from.y - y), b = corner(from.x + x, from.y + y),
                c = corner(to.x + x, to.y + y), d = corner(to.x - x, to.y - y);
    glyphs_.insert(glyphs_.end(), {a, b, c, a, c, d});
  }

  void rectangle(float x, float y, float w, float h, Color color) {
    const ImVec2 white = font_.ContainerAtlas->TexUvWhitePixel;
    quad({x, y, x + w, y + h}, {white.x, white.y, white.x, white.y}, color, kNeverHidden);
  }

  const std::vector<Glyph>& glyphs() const { return glyphs_; }

 private:
  struct Rect {
    float x0, y0, x1, y1;
  };
  const ImFontGlyph* glyph(char c) const { return font_.FindGlyph(ImWchar(static_cast<unsigned char>(c))); }
  float advance(char c) const {
    const ImFontGlyph* g = glyph(c);
    return g ? g->AdvanceX : 0.0f;
  }
  void quad(const Rect& at, const Rect& uv, Color color, const pfx::Vec3& anchor) {
    const Glyph a{at.x0, at.y0, uv.x0, uv.y0, color, anchor}, b{at.x1, at.y0, uv.x1, uv.y0, color, anchor};
    const Glyph c{at.x1, at.y1, uv.x1, uv.y1, color, anchor}, d{at.x0, at.y1, uv.x0, uv.y1, color, anchor};
    glyphs_.insert(glyphs_.end(), {a, b, c, a, c, d});
  }

  const ImFont& font_;
  float scale_;
  std::vector<Glyph> glyphs_;
};

void layOnScreen(TextLayout& layout, LabelPlaces& places, const Label& label, const LabelPass::Input& in) {
  const float text_width = layout.width(label.text);
  float x = label.position.x(), y = label.position.y();
  if (std::signbit(x)) x += float(in.width) - text_width;
  if (std::signbit(y)) y += float(in.height) - layout.height();
  layout.text(x, y, label.text, label.color, kNeverHidden);
  places.take({x, y, x + text_width, y + layout.height()});
}

// Beside its anchor, or as near as there is room, then with a line to it. One without room is left out.
void layInWorld(TextLayout& layout, LabelPlaces& places, const Label& label, const LabelPass::Input& in) {
  const Eigen::Vector4f clip = in.frame->clip_from_world * label.position.homogeneous();
  if (!(clip.w() > 0.0f) || clip.z() < -clip.w()) return;
  const pfx::Vec3 at = 0.5f * (clip.head<3>() / clip.w()) + pfx::Vec3::Constant(0.5f);
  // The anchor is slightly nearer than it is, so that a label on a surface is not hidden by that surface.
  const pfx::Vec3 anchor(at.x(), at.y(), at.z() - 0.002f * (1.0f - at.z()));
  const Point2 tip = {at.x() * float(in.width), (1.0f - at.y()) * float(in.height)};
  const float w = float(in.width), h = float(in.height), text_width = layout.width(label.text);
  float x = tip.x + 6.0f * in.scale, y = tip.y - 0.5f * layout.height();
  // What is in the picture has its label in the picture.
  if (tip.x >= 0.0f && tip.x <= w && tip.y >= 0.0f && tip.y <= h) {
    x = std::max(0.0f, std::min(x, w - text_width));
    y = std::max(0.0f, std::min(y, h - layout.height()));
  }
  const auto place = places.find({x, y, x + text_width, y + layout.height()}, tip.x);
  if (!place) return;
  if (place->x0 != x || place->y0 != y) {
    const Point2 edge = {place->x0 > tip.x ? place->x0 - 1.0f : place->x1 + 1.0f, 0.5f * (place->y0 + place->y1)};
    layout.line(tip, edge, (label.color & 0x00ffffffu) | 0xb0000000u, anchor);
  }
  layout.text(place->x0, place->y0, label.text, label.color, anchor);
}

void layLegend(TextLayout& layout, LabelPlaces& places, const DrawList& list, const LabelPass::Input& in) {
  float y = 10.0f * in.scale;
  for (const LegendEntry& entry : list.legend()) {
    const float right = float(in.width) - in.covered_right, side = layout.height(),
                x = right - layout.width(entry.text) - 10.0f * in.scale;
    layout.rectangle(x - 1.6f * side, y + 0.1f * side, side, 0.8f * side, entry.color);
    layout.text(x, y, entry.text, 0xff20242bu, kNeverHidden);
    places.take({x - 1.6f * side, y, right, y + side});
    y += 1.25f * side;
  }
}

// The longest of 1, 2 or 5 times a power of ten metres that fits in a fifth of the picture, at the camera's
// target.
void layScaleBar(TextLayout& layout, const Camera& camera, const LabelPass::Input& in) {
  const float span = camera.orthographic
                         ? camera.ortho_height_m
                         : 2.0f * in.frame->ray_up.head<3>().norm() * (camera.target - camera.eye).norm();
  const float metres_per_pixel = span / float(in.height);
  const float room = 0.2f * float(in.width) * metres_per_pixel;
  if (!(room > 1e-6f) || !std::isfinite(room)) return;
  float length = std::pow(10.0f, std::floor(std::log10(room)));
  length *= room / length >= 5.0f ? 5.0f : room / length >= 2.0f ? 2.0f : 1.0f;
  const float w = std::round(length / metres_per_pixel), x = 12.0f * in.scale,
              y = float(in.height) - 14.0f * in.scale;
  const float thick = std::round(2.0f * in.scale), tick = std::round(6.0f * in.scale);
  layout.rectangle(x, y, w, thick, 0xff20242bu);
  layout.rectangle(x, y - tick + thick, thick, tick, 0xff20242bu);
  layout.rectangle(x + w - thick, y - tick + thick, thick, tick, 0xff20242bu);
  char text[32];
  if (length >= 1.0f)
    std::snprintf(text, sizeof text, "%.0f m", double(length));
  else if (length >= 0.01f)
    std::snprintf(text, sizeof text, "%.0f cm", 100.0 * double(length));
  else
    std::snprintf(text, sizeof text, "%.3g mm", 1000.0 * double(length));
  layout.text(x + 0.5f * (w - layout.width(text)), y - layout.height() - 3.0f * in.scale, text, 0xff20242bu,
              kNeverHidden);
}

}  // namespace

LabelPass::LabelPass(const Gl& gl, const std::string& shaders)
    : gl_(&gl),
      program_(gl, {"label.vert.glsl", "label.frag.glsl", {}, shaders}),
      array_(gl),
      buffer_(gl),
      font_texture_(gl),
      font_(new ImFontAtlas, [](ImFontAtlas* atlas) { delete atlas; }) {
  font_->TexGlyphPadding = 4;  // room for the halo
  font_->AddFontDefault();
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  font_->GetTexDataAsRGBA32(&pixels, &width, &height);
  gl.BindTexture(GL_TEXTURE_2D, font_texture_.id());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);

  gl.BindVertexArray(array_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  const auto at = [](size_t offset) { return reinterpret_cast<const void*>(offset); };
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(Glyph), at(offsetof(Glyph, x)));
  gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(Glyph), at(offsetof(Glyph, u)));
  gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Glyph), at(offsetof(Glyph, color)));
  gl.VertexAttribPointer(3, 3, GL_FLOAT, GL_FALSE, sizeof(Glyph), at(offsetof(Glyph, anchor)));
  for (GLuint i = 0; i < 4; ++i) gl.EnableVertexAttribArray(i);
  gl.BindVertexArray(0);
}

void LabelPass::draw(const DrawList& list, const Input& in) {
  if (list.labels().empty() && list.legend().empty() && !list.scale_bar) return;
  TextLayout layout(*font_->Fonts[0], in.scale);
  LabelPlaces places(float(in.height), layout.height());
  layLegend(layout, places, list, in);
  for (const Label& label : list.labels())
    if (label.on_screen) layOnScreen(layout, places, label, in);
  for (const Label& label : list.labels())
    if (!label.on_screen) layInWorld(layout, places, label, in);
  if (list.scale_bar) layScaleBar(layout, list.camera, in);
  const std::vector<Glyph>& glyphs = layout.glyphs();
  if (glyphs.empty()) return;

  apply(*gl_, {.blend = Blend::Alpha});
  program_.use();
  program_.bind("t_font", 0, font_texture_.id());
  program_.bind("t_depth", 1, in.depth);
  program_.set("u_pixels", float(in.width), float(in.height));
  program_.set("u_texel", 1.0f / float(font_->TexWidth), 1.0f / float(font_->TexHeight));
  gl_->BindVertexArray(array_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, GLsizeiptr(glyphs.size() * sizeof(Glyph)), glyphs.data(), GL_STREAM_DRAW);
  gl_->DrawArrays(GL_TRIANGLES, 0, GLsizei(glyphs.size()));
  gl_->BindVertexArray(0);
  gl_->ActiveTexture(GL_TEXTURE0);
}

}  // namespace viewer
