#pragma once

namespace pleinair::session {

/// Milliseconds spent on composing a frame, by stage.
struct RenderTimes {
  double light_ms = 0.0;      ///< Sun, sky and indirect illumination; nearly always 0.
  double animation_ms = 0.0;  ///< Shapes of animated objects; 0 without any.
  double meter_ms = 0.0;      ///< Exposure estimate from the marker.
  double compose_ms = 0.0;    ///< Drawing and compositing.
};

}  // namespace pleinair::session
