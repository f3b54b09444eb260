#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "app/window/window_state.h"

namespace pleinair::app {

/// Draws the panel with everything of the scene that can be changed, into the current ImGui frame.
class ScenePanel {
 public:
  /// From its upper left corner, in screen coordinates.
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
  // Elevations of the sun over a day, kept while day and place stay.
  std::array<float, 97> elevations_deg_{};
  double elevations_of_latitude_ = 1e9, elevations_of_longitude_ = 1e9;
  std::int64_t elevations_of_day_ = -1;
};

/// The keys, for people: drawn over the picture.
void DrawKeyHelp(float screen_width, float screen_height, bool* open);

/// A key of GLFW's with what it does.
struct KeyBinding {
  int key;
  bool control;
  Action action;
  const char* keys;   ///< As people read it.
  const char* words;  ///< What it does; null: described by the binding before.
};
std::span<const KeyBinding> KeyBindings();

}  // namespace pleinair::app
