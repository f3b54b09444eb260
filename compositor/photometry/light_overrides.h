#pragma once

#include <cstddef>
#include <optional>

namespace pleinair::compositor {

/// Maximum plausible sun-to-sky ratio of a clear sky. High mountains have 10.
inline constexpr double kMaxSunToSky = 20.0;

/// Values that the user provides in place of estimates.
struct LightOverrides {
  /// Uses the scene description. Only the exposure scale and unmodelled shadows on the ground are
  /// measured.
  bool as_described = false;
  /// Estimates by one fit (estimate/fitted_light.h) where no ratio is given.
  bool fitted = false;
  /// Sun's illuminance of level ground over the sky's; 0: no sun.
  std::optional<double> sun_to_sky;
  std::optional<double> heading_deg;  ///< Heading of the marker, as in the scene.
  /// Maximum number of radiosity patches (LightSolverOptions).
  std::optional<std::size_t> max_patches;
};

}  // namespace pleinair::compositor
