#include "viewer/render/renderer.h"

#include <algorithm>
#include <cstring>

#include "viewer/render/passes.h"

namespace viewer {

namespace {

struct QualitySettings {
  int side;        // samples along a pixel's side
  int shadow_map;  // texels along a side
  bool occlusion;
};

QualitySettings settingsOf(Quality quality) {
  switch (quality) {
    case Quality::Ci:
      return {2, 1024, false};
    case Quality::Window:
      return {1, 2048, false};
    case Quality::Hero:
      return {3, 4096, true};
  }
  return {2, 1024, false};
}

constexpr int kMaxSize = 8192;  // px

void checkSize(const FrameInput& frame) {
  if (frame.width < 1 || frame.height < 1 || frame.width > kMaxSize || frame.height > kMaxSize)
    throw RenderError("a picture of " + std::to_string(frame.width) + " x " + std::to_string(frame.height) +
                      " px: each side must be 1 to " + std::to_string(kMaxSize));
}

}  // namespace

struct Renderer::Impl {
  GlContext& context;
  const Gl& gl;
  QualitySettings quality;
  ShadowPass shadow;
  SolidPass solids;
  SkyPass sky;
  OcclusionPass occlusion;
  OverlayPass overlay;
  ResolvePass resolve;
  IdPass ids;
  OutlinePass outline;
  LabelPass labels;
  UiPass ui;
  SolidStore store;
  GlBuffer frame_buffer;
  Target scene;   // samples
  Target id_map;  // pixels
  Target output;  // pixels

  Impl(GlContext& c, const RenderParams& p)
      : context(c),
        gl(c.gl()),
        quality(settingsOf(p.quality)),
        shadow(gl, p.shader_dir, quality.shadow_map),
        solids(gl, p.shader_dir, {.wide_shadow = quality.shadow_map > 1024, .wire = p.wire}),
        sky(gl, p.shader_dir),
        occlusion(gl, p.shader_dir),
        overlay(gl, p.shader_dir),
        resolve(gl, p.shader_dir),
        ids(gl, p.shader_dir),
        outline(gl, p.shader_dir),
        labels(gl, p.shader_dir),
        ui(gl, p.shader_dir),
        store(gl),
        frame_buffer(gl) {}

  void fit(Target& target, int width, int height, const TargetFormat& format) {
    if (target.width() != width || target.height() != height) target = Target(gl, width, height, format);
  }

  void sendFrame(const FrameBlock& block) {
    gl.BindBuffer(GL_UNIFORM_BUFFER, frame_buffer.id());
    gl.BufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_buffer.id());
  }

  void drawScene(const DrawList& list, const FrameBlock& block, const SunView& sun) {
    shadow.draw(list.sun.shadows ? std::span<const SolidDraw>(store.draws()) : std::span<const SolidDraw>(),
                sun);
    scene.bind();
    apply(gl, {.depth = Depth::TestAndWrite});
    gl.ClearDepth(1.0);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    solids.draw(store.draws(), block, {shadow.map(), shadowReach(list, sun, block)});
    if (quality.occlusion) {
      occlusion.draw(scene, block, 0.06f * (list.camera.target - list.camera.eye).norm());
      scene.bind();
    }
    sky.draw();
    solids.drawTranslucent(store.translucentDraws(), block, shadow.map());
    overlay.draw(scene.width(), scene.height(), quality.side);
  }

  FrameBlock drawIds(const FrameInput& frame, const DrawList& list) {
    fit(id_map, frame.width, frame.height, {.color = GL_R32UI, .depth = true});
    id_map.bind();
    apply(gl, {.depth = Depth::TestAndWrite});
    const GLuint nothing[4] = {0, 0, 0, 0};
    gl.ClearBufferuiv(GL_COLOR, 0, nothing);
    gl.ClearDepth(1.0);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    const SunView sun = fitSun(list, quality.shadow_map);
    const FrameBlock block = makeFrameBlock(list, {frame.width, frame.height, 1}, sun, quality.shadow_map);
    sendFrame(block);
    ids.draw(store.draws(), block);
    overlay.drawIds(frame.width, frame.height);
    return block;
  }

  void checkErrors() {
    if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) {
      char text[64];
      std::snprintf(text, sizeof text, "OpenGL reports error 0x%04x", error);
      throw RenderError(text);
    }
  }
};

Renderer::Renderer(GlContext& context, const RenderParams& params) {
  context.makeCurrent();
  impl_ = std::make_unique<Impl>(context, params);
  impl_->gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  impl_->gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  impl_->checkErrors();
}

Renderer::~Renderer() { impl_->context.makeCurrent(); }

RenderStats Renderer::draw(const FrameInput& frame, const DrawList& list) {
  checkSize(frame);
  Impl& r = *impl_;
  r.context.makeCurrent();
  const int side = r.quality.side;
  r.fit(r.scene, frame.width * side, frame.height * side, {.color = GL_RGBA8, .depth = true});
  r.fit(r.output, frame.width, frame.height, {.color = GL_RGBA8});

  RenderStats stats;
  stats.uploaded_bytes = r.store.update(list) + r.overlay.update(list);
  const SunView sun = fitSun(list, r.quality.shadow_map);
  if (frame.selected) r.drawIds(frame, list);
  const FrameBlock block = makeFrameBlock(list, {frame.width, frame.height, side}, sun, r.quality.shadow_map);
  r.sendFrame(block);
  r.drawScene(list, block, sun);

  r.output.bind();
  r.resolve.draw(r.scene.color(), side);
  if (frame.selected) r.outline.draw(r.id_map.color(), frame.selected);
  r.labels.draw(list, {&block, r.scene.depth(), frame.width, frame.height, frame.label_scale, frame.covered_right});
  if (frame.ui) r.ui.draw(*frame.ui, frame.width, frame.height);
  r.checkErrors();

  for (const SolidDraw& d : r.store.draws()) {
    ++stats.draw_calls;
    stats.instances += uint32_t(d.instances);
    stats.triangles += uint32_t(d.instances * d.vertices / 3);
  }
  stats.lines = uint32_t(r.overlay.count());
  return stats;
}

Image Renderer::readBack() {
  Impl& r = *impl_;
  if (r.output.width() == 0) throw RenderError("there is no picture to read: nothing was drawn");
  r.context.makeCurrent();
  Image image;
  image.width = r.output.width();
  image.height = r.output.height();
  const size_t row = size_t(image.width) * 4;
  std::vector<uint8_t> upside_down(row * size_t(image.height));
  r.gl.BindFramebuffer(GL_FRAMEBUFFER, r.output.framebuffer());
  r.gl.ReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.data());
  r.checkErrors();
  image.rgba.resize(upside_down.size());
  for (size_t y = 0; y < size_t(image.height); ++y)
    std::memcpy(&image.rgba[y * row], &upside_down[(size_t(image.height) - 1 - y) * row], row);
  // Alpha has served its purpose.
  for (size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  const bool blank =
      image.rgba.size() > 64 && std::memcmp(&image.rgba[0], &image.rgba[4], image.rgba.size() - 4) == 0;
  if (blank) throw RenderError("the picture is blank: all pixels are equal");
  return image;
}

std::vector<uint32_t> Renderer::readIds(const FrameInput& frame, const DrawList& list) {
  checkSize(frame);
  Impl& r = *impl_;
  r.context.makeCurrent();
  r.store.update(list);
  r.overlay.update(list);
  r.drawIds(frame, list);
  std::vector<uint32_t> ids(size_t(frame.width) * size_t(frame.height));
  r.gl.ReadPixels(0, 0, frame.width, frame.height, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
  r.checkErrors();
  for (int y = 0; y < frame.height / 2; ++y)
    std::swap_ranges(ids.begin() + ptrdiff_t(y) * frame.width, ids.begin() + ptrdiff_t(y + 1) * frame.width,
                     ids.begin() + ptrdiff_t(frame.height - 1 - y) * frame.width);
  return ids;
}

PickHit Renderer::pick(const FrameInput& frame, const DrawList& list, int x, int y) {
  checkSize(frame);
  PickHit hit;
  if (x < 0 || y < 0 || x >= frame.width || y >= frame.height) return hit;
  Impl& r = *impl_;
  r.context.makeCurrent();
  r.store.update(list);
  r.overlay.update(list);
  const FrameBlock block = r.drawIds(frame, list);
  float depth = 1.0f;
  const int row = frame.height - 1 - y;
  r.gl.ReadPixels(x, row, 1, 1, GL_RED_INTEGER, GL_UNSIGNED_INT, &hit.id);
  r.gl.ReadPixels(x, row, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
  r.checkErrors();
  const Eigen::Vector4f clip(2.0f * (float(x) + 0.5f) / float(frame.width) - 1.0f,
                             2.0f * (float(row) + 0.5f) / float(frame.height) - 1.0f, 2.0f * depth - 1.0f, 1.0f);
  hit.position = (block.clip_from_world.inverse() * clip).hnormalized();
  return hit;
}

void Renderer::blit(int window_width, int window_height) {
  Impl& r = *impl_;
  r.context.makeCurrent();
  r.gl.BindFramebuffer(GL_READ_FRAMEBUFFER, r.output.framebuffer());
  r.gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  const GLenum filter =
      window_width == r.output.width() && window_height == r.output.height() ? GL_NEAREST : GL_LINEAR;
  r.gl.BlitFramebuffer(0, 0, r.output.width(), r.output.height(), 0, 0, window_width, window_height,
                       GL_COLOR_BUFFER_BIT, filter);
  r.checkErrors();
}

std::string Renderer::rasterizer(GlContext& context) {
  context.makeCurrent();
  const auto* text = reinterpret_cast<const char*>(context.gl().GetString(GL_RENDERER));
  return text ? text : "unknown";
}

std::string Renderer::fingerprint() const {
  const std::string renderer = rasterizer(impl_->context);
  const auto* version = reinterpret_cast<const char*>(impl_->gl.GetString(GL_VERSION));
  return renderer + " | " + (version ? version : "unknown");
}

}  // namespace viewer
