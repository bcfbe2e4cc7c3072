#include "viewer/browse/ui_style.h"

#include <imgui.h>

#include <cmath>
#include <filesystem>

namespace viewer {

namespace {

// A common font where it is installed. Pictures that are compared never show it.
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf"};

void addFont(ImFontAtlas& fonts, float scale) {
  std::error_code ignored;
  for (const char* file : kFonts)
    if (std::filesystem::exists(file, ignored) && fonts.AddFontFromFileTTF(file, std::round(14.0f * scale)))
      return;
  ImFontConfig config;
  config.SizePixels =
      13.0f * std::max(1.0f, std::round(scale));  // a bitmap font: only whole factors look right
  fonts.AddFontDefault(&config);
}

}  // namespace

void setUiStyle(float scale) {
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 8.0f;
  style.FrameRounding = 5.0f;
  style.GrabRounding = 5.0f;
  style.WindowBorderSize = 0.0f;
  style.WindowPadding = ImVec2(10.0f, 8.0f);
  style.ItemSpacing = ImVec2(7.0f, 5.0f);
  ImVec4* c = style.Colors;
  c[ImGuiCol_WindowBg] = ImVec4(0.985f, 0.98f, 0.97f, 0.90f);
  c[ImGuiCol_ChildBg] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_PopupBg] = ImVec4(0.99f, 0.985f, 0.975f, 0.97f);
  c[ImGuiCol_Text] = ImVec4(0.15f, 0.17f, 0.20f, 1.0f);
  c[ImGuiCol_TextDisabled] = ImVec4(0.47f, 0.48f, 0.50f, 1.0f);
  c[ImGuiCol_FrameBg] = ImVec4(0.87f, 0.875f, 0.87f, 1.0f);
  c[ImGuiCol_Button] = ImVec4(0.85f, 0.86f, 0.87f, 1.0f);
  c[ImGuiCol_Header] = ImVec4(0.91f, 0.70f, 0.50f, 0.45f);
  c[ImGuiCol_HeaderHovered] = ImVec4(0.91f, 0.70f, 0.50f, 0.65f);
  c[ImGuiCol_HeaderActive] = ImVec4(0.88f, 0.60f, 0.38f, 0.85f);
  c[ImGuiCol_ButtonHovered] = ImVec4(0.93f, 0.78f, 0.64f, 1.0f);
  c[ImGuiCol_ButtonActive] = ImVec4(0.88f, 0.62f, 0.40f, 1.0f);
  c[ImGuiCol_SliderGrab] = ImVec4(0.86f, 0.56f, 0.33f, 1.0f);
  c[ImGuiCol_SliderGrabActive] = ImVec4(0.76f, 0.44f, 0.22f, 1.0f);
  c[ImGuiCol_CheckMark] = ImVec4(0.76f, 0.42f, 0.18f, 1.0f);
  c[ImGuiCol_TableHeaderBg] = ImVec4(0.90f, 0.90f, 0.89f, 1.0f);
  c[ImGuiCol_TableRowBgAlt] = ImVec4(0.30f, 0.30f, 0.30f, 0.05f);
  c[ImGuiCol_PlotLines] = ImVec4(0.30f, 0.45f, 0.62f, 1.0f);
  c[ImGuiCol_Tab] = ImVec4(0.89f, 0.89f, 0.88f, 1.0f);
  c[ImGuiCol_TabHovered] = c[ImGuiCol_ButtonHovered];
  c[ImGuiCol_TabActive] = ImVec4(0.93f, 0.75f, 0.58f, 1.0f);
  c[ImGuiCol_FrameBgHovered] = ImVec4(0.93f, 0.86f, 0.80f, 1.0f);
  c[ImGuiCol_FrameBgActive] = ImVec4(0.93f, 0.82f, 0.72f, 1.0f);
  style.ScaleAllSizes(scale);
  addFont(*ImGui::GetIO().Fonts, scale);
  ImGui::GetIO().Fonts->Build();
}

}  // namespace viewer
