#pragma once

#include "app/window/window_state.h"

namespace pleinair::app {

/// Draws the panel's section for ground, boxes and walls, into the current ImGui window.
void DrawSurfaceSection(WindowState* state);

}  // namespace pleinair::app
