#pragma once

namespace pleinair::app {

/// Colours, spacing and letters of the window, for a screen whose things are `scale` times as large
/// as usual (HiDPI). Letters are DejaVu Sans where it is installed.
void SetWindowStyle(float scale);

}  // namespace pleinair::app
