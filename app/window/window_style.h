#pragma once

namespace pleinair::app {

/// Sets colors, spacing and font of the window. `scale`: the screen's scale (HiDPI). The font is
/// DejaVu Sans where it is installed.
void SetWindowStyle(float scale);

}  // namespace pleinair::app
