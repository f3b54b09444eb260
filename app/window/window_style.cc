#include "app/window/window_style.h"

#include <imgui.h>

#include <cmath>
#include <filesystem>
#include <system_error>

namespace pleinair::app {
namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float kLetters_px = 15.0F;

}  // namespace

void SetWindowStyle(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // Do not write a settings file.
  std::error_code error;
  // Latin with accents, Greek, and the ellipsis.
  static constexpr ImWchar kLetters[] = {0x20, 0x17F, 0x370, 0x3FF, 0x2010, 0x203A, 0};
  const float size = std::round(kLetters_px * scale);
  if (std::filesystem::exists(kFont, error)) {
    io.Fonts->AddFontFromFileTTF(kFont, size, nullptr, kLetters);
  } else {
    ImFontConfig config;
    config.SizePixels = std::round(13.0F * scale);
    io.Fonts->AddFontDefault(&config);
  }
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0.0F;
  style.FrameRounding = 4.0F;
  style.GrabRounding = 4.0F;
  style.PopupRounding = 4.0F;
  style.ScrollbarRounding = 6.0F;
  style.WindowBorderSize = 0.0F;
  style.WindowPadding = {12.0F, 10.0F};
  style.FramePadding = {7.0F, 3.5F};
  style.ItemSpacing = {8.0F, 5.5F};
  style.ScaleAllSizes(scale);
  const auto set = [&](ImGuiCol color, float r, float g, float b, float a = 1.0F) {
    style.Colors[color] = {r, g, b, a};
  };
  set(ImGuiCol_WindowBg, 0.098F, 0.106F, 0.114F);
  set(ImGuiCol_PopupBg, 0.12F, 0.13F, 0.14F, 0.98F);
  set(ImGuiCol_Text, 0.90F, 0.91F, 0.92F);
  set(ImGuiCol_FrameBg, 0.17F, 0.185F, 0.20F);
  set(ImGuiCol_FrameBgHovered, 0.22F, 0.24F, 0.26F);
  set(ImGuiCol_FrameBgActive, 0.25F, 0.28F, 0.31F);
  set(ImGuiCol_Header, 0.145F, 0.16F, 0.175F);
  set(ImGuiCol_HeaderHovered, 0.20F, 0.225F, 0.25F);
  set(ImGuiCol_HeaderActive, 0.23F, 0.26F, 0.29F);
  set(ImGuiCol_Button, 0.20F, 0.29F, 0.37F);
  set(ImGuiCol_ButtonHovered, 0.25F, 0.37F, 0.47F);
  set(ImGuiCol_ButtonActive, 0.29F, 0.43F, 0.55F);
  // Dark enough for the number that it may cover.
  set(ImGuiCol_SliderGrab, 0.66F, 0.47F, 0.14F);
  set(ImGuiCol_SliderGrabActive, 0.78F, 0.57F, 0.20F);
  set(ImGuiCol_TitleBg, 0.145F, 0.16F, 0.175F);
  set(ImGuiCol_TitleBgActive, 0.145F, 0.16F, 0.175F);
  set(ImGuiCol_CheckMark, 1.0F, 0.82F, 0.42F);
  set(ImGuiCol_PlotHistogram, 0.93F, 0.73F, 0.33F);
}

}  // namespace pleinair::app
