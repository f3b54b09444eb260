#pragma once

// Internal: not installed.

#include <algorithm>

namespace pleinair::session {

/// Standard deviation of a coordinate of a marker's corner, pixels. It is 0.1 px / v² with the
/// visible fraction v of the marker, at least 0.2 (docs/method/tracker.md, "Anchors"). Corners of
/// covered markers are extrapolated.
inline double CornerDeviation_px(double visible_fraction) {
  constexpr double kWhole_px = 0.1, kMinVisible = 0.2;
  const double visible = std::clamp(visible_fraction, kMinVisible, 1.0);
  return kWhole_px / (visible * visible);
}

}  // namespace pleinair::session
