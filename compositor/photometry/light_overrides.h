#pragma once

#include <cstddef>
#include <optional>

namespace pleinair::compositor {

/// Largest plausible sun-to-sky ratio of a clear sky; high mountains have 10.
inline constexpr double kMaxSunToSky = 20.0;

/// What the user says of the light, in place of what the frames show.
struct LightOverrides {
  /// Measure nothing but the exposure scale and whether trees shade the ground: believe the scene.
  bool as_described = false;
  std::optional<double> sun_to_sky;  ///< Sun's illuminance of level ground over the sky's; 0: none.
  std::optional<double> heading_deg;  ///< Of the marker, as in the scene.
  /// Where light is gathered, at most (LightSolverOptions).
  std::optional<std::size_t> max_patches;
};

}  // namespace pleinair::compositor
