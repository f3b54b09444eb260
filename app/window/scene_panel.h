#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "app/window/window_state.h"

namespace pleinair::app {

/// Draws the panel for editing the scene, into the current ImGui frame.
class ScenePanel {
 public:
  /// `corner`: upper left, screen coordinates.
  void Draw(Vec2 corner, Vec2 size, UtcTime now, WindowState* state);

 private:
  void PlaceAndTime(UtcTime now, WindowState* state);
  void SunOverTheDay(double utc_offset_s, const WindowState& state);
  static void Air(WindowState* state);
  static void Shadows(WindowState* state);
  static void Light(WindowState* state);
  static void North(WindowState* state);
  static void Objects(WindowState* state);
  static void Capture(WindowState* state);
  static void Statistics(const WindowState& state);

  char city_[64] = "";
  // Elevations of the sun over a day, cached while day and place stay the same.
  std::array<float, 97> elevations_deg_{};
  double elevations_of_latitude_ = 1e9, elevations_of_longitude_ = 1e9;
  std::int64_t elevations_of_day_ = -1;
};

/// Draws the help for the keys over the image.
void DrawKeyHelp(float screen_width, float screen_height, bool* open);

/// A GLFW key and its action.
struct KeyBinding {
  int key;
  bool control;
  Action action;
  const char* keys;   ///< As text for the user.
  const char* words;  ///< Description; null: described by the previous binding.
};
std::span<const KeyBinding> KeyBindings();

}  // namespace pleinair::app
