#include <GLFW/glfw3.h>
#include <imgui.h>

#include <array>
#include <span>

#include "app/window/scene_panel.h"

namespace pleinair::app {
namespace {

constexpr std::array kBindings = {
    KeyBinding{GLFW_KEY_F1, false, Action::kHelp, "F1", "these keys"},
    KeyBinding{GLFW_KEY_F2, false, Action::kPanel, "F2", "panel on and off"},
    KeyBinding{GLFW_KEY_TAB, false, Action::kNextObject, "Tab", "next object"},
    KeyBinding{GLFW_KEY_ESCAPE, false, Action::kDeselect, "Esc", "deselect"},
    KeyBinding{GLFW_KEY_LEFT, false, Action::kMoveLeft, "Arrows", "move over the ground"},
    KeyBinding{GLFW_KEY_RIGHT, false, Action::kMoveRight, "", nullptr},
    KeyBinding{GLFW_KEY_UP, false, Action::kMoveAway, "", nullptr},
    KeyBinding{GLFW_KEY_DOWN, false, Action::kMoveNearer, "", nullptr},
    KeyBinding{GLFW_KEY_PAGE_UP, false, Action::kRaise, "Page up, down", "raise, lower"},
    KeyBinding{GLFW_KEY_PAGE_DOWN, false, Action::kLower, "", nullptr},
    KeyBinding{GLFW_KEY_Q, false, Action::kTurnLeft, "Q, E", "turn"},
    KeyBinding{GLFW_KEY_E, false, Action::kTurnRight, "", nullptr},
    KeyBinding{GLFW_KEY_EQUAL, false, Action::kGrow, "+, -", "larger, smaller"},
    KeyBinding{GLFW_KEY_KP_ADD, false, Action::kGrow, "", nullptr},
    KeyBinding{GLFW_KEY_MINUS, false, Action::kShrink, "", nullptr},
    KeyBinding{GLFW_KEY_KP_SUBTRACT, false, Action::kShrink, "", nullptr},
    KeyBinding{GLFW_KEY_HOME, false, Action::kResetObject, "Home", "reset the object or surface"},
    KeyBinding{GLFW_KEY_LEFT_BRACKET, false, Action::kEarlier, "[ ]", "ten minutes earlier, later"},
    KeyBinding{GLFW_KEY_RIGHT_BRACKET, false, Action::kLater, "", nullptr},
    KeyBinding{GLFW_KEY_N, false, Action::kNow, "N", "use the current time"},
    KeyBinding{GLFW_KEY_T, false, Action::kAsRecorded, "T", "use the images' time"},
    KeyBinding{GLFW_KEY_O, false, Action::kNorth, "O", "find north by a pole's shadow"},
    KeyBinding{GLFW_KEY_G, false, Action::kSurfaces, "G", "move ground, boxes and walls"},
    KeyBinding{GLFW_KEY_M, false, Action::kShadowMaps, "M", "show shadow-map partitions and maps"},
    KeyBinding{GLFW_KEY_L, false, Action::kLockExposure, "L", "lock the exposure"},
    KeyBinding{GLFW_KEY_S, true, Action::kSaveScene, "Ctrl+S", "save the scene"},
    KeyBinding{GLFW_KEY_P, true, Action::kScreenshot, "Ctrl+P",
               "screenshot (Shift: the whole window)"},
    KeyBinding{GLFW_KEY_R, true, Action::kRecord, "Ctrl+R", "record, end recording"},
    KeyBinding{GLFW_KEY_Q, true, Action::kClose, "Ctrl+Q", "close"},
};

}  // namespace

std::span<const KeyBinding> KeyBindings() { return kBindings; }

void DrawKeyHelp(float screen_width, float screen_height, bool* open) {
  ImGui::SetNextWindowPos({screen_width / 2, screen_height / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowBgAlpha(0.97F);
  if (ImGui::Begin("Keys and mouse", open,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoCollapse)) {
    const auto row = [](const char* keys, const char* words) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(keys);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(words);
    };
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
      for (const KeyBinding& binding : kBindings) {
        if (binding.words != nullptr) row(binding.keys, binding.words);
      }
      row("Shift with them", "small steps");
      ImGui::TableNextRow();
      row("Drag", "move an object over the ground (with G: a surface)");
      row("Shift+drag", "raise or lower it");
      row("Right drag", "turn it");
      row("Wheel over it", "larger, smaller");
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace pleinair::app
