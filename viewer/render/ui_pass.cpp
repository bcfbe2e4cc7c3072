// Paints Dear ImGui's triangles. The library's own GL backend cannot load its functions from OSMesa; this one
// needs only ours, and so works on every backend.
#include <imgui.h>

#include "viewer/render/passes.h"

namespace viewer {

UiPass::UiPass(const Gl& gl, const std::string& shaders)
    : gl_(&gl),
      program_(gl, {"ui.vert.glsl", "ui.frag.glsl", {}, shaders}),
      array_(gl),
      vertices_(gl),
      indices_(gl) {
  gl.BindVertexArray(array_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  const auto at = [](size_t offset) { return reinterpret_cast<const void*>(offset); };
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(ImDrawVert), at(offsetof(ImDrawVert, pos)));
  gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(ImDrawVert), at(offsetof(ImDrawVert, uv)));
  gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(ImDrawVert), at(offsetof(ImDrawVert, col)));
  for (GLuint i = 0; i < 3; ++i) gl.EnableVertexAttribArray(i);
  gl.BindVertexArray(0);
}

void UiPass::uploadFonts() {
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  font_texture_ = GlTexture(*gl_);
  gl_->BindTexture(GL_TEXTURE_2D, font_texture_.id());
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void UiPass::draw(const ImDrawData& data, int width, int height) {
  if (data.TotalVtxCount == 0 || data.DisplaySize.x <= 0.0f || data.DisplaySize.y <= 0.0f) return;
  if (!font_texture_) uploadFonts();
  apply(*gl_, {.blend = Blend::Alpha});
  gl_->Enable(GL_SCISSOR_TEST);
  gl_->Viewport(0, 0, width, height);
  program_.use();
  program_.set("u_window",
               Eigen::Vector4f(data.DisplayPos.x, data.DisplayPos.y, data.DisplaySize.x, data.DisplaySize.y));
  gl_->BindVertexArray(array_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  for (int i = 0; i < data.CmdListsCount; ++i) drawList(*data.CmdLists[i], data, height);
  gl_->BindVertexArray(0);
  gl_->Disable(GL_SCISSOR_TEST);
}

void UiPass::drawList(const ImDrawList& list, const ImDrawData& data, int height) const {
  gl_->BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
  gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data,
                  GL_STREAM_DRAW);
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const ImVec4 clip = command.ClipRect;
    const float x = clip.x - data.DisplayPos.x, y = clip.y - data.DisplayPos.y;
    const float w = clip.z - clip.x, h = clip.w - clip.y;
    if (w <= 0.0f || h <= 0.0f || command.ElemCount == 0) continue;
    gl_->Scissor(GLint(x), GLint(float(height) - y - h), GLsizei(w), GLsizei(h));
    const auto texture = GLuint(reinterpret_cast<uintptr_t>(command.TextureId));
    program_.bind("t_image", 0, texture ? texture : font_texture_.id());
    gl_->DrawElementsBaseVertex(GL_TRIANGLES, GLsizei(command.ElemCount),
                                sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
                                GLint(command.VtxOffset));
  }
}

}  // namespace viewer
