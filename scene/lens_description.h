#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::scene {

/// What a scene or a recording states about focus, aperture and exposure.
struct LensDescription {
  /// Reciprocal distances in focus, 1/m, 0 for infinity: none, one, or one a frame.
  std::vector<double> focus_dioptres;
  std::optional<double> aperture_m;  ///< Diameter of the entrance pupil.
  int blades = 0;                    ///< Blades of the stop; 0: round.
  double blade_rotation_deg = 0.0;   ///< One corner's angle from the image's right, clockwise.
  /// Times for which the shutter is open, seconds: none, one, or one a frame.
  std::vector<double> exposure_s;

  /// True if it states focus and aperture.
  bool IsComplete() const { return !focus_dioptres.empty() && aperture_m.has_value(); }
};

/// The keys of [lens] as written.
struct LensFacts {
  std::optional<std::vector<double>> focus_m;  ///< May hold infinity.
  std::optional<std::vector<double>> focus_dioptres;
  std::optional<double> aperture_mm, f_number, focal_length_mm;
  std::optional<int> blades;
  std::optional<double> blade_rotation_deg;
  std::optional<std::vector<double>> exposure_ms;
};

/// Checks the keys and completes the description. `where`: file, and line where there is one.
/// Errors (input): values not greater than zero; keys that exclude or need one another; one, two or
/// more than 16 blades; a focus nearer than the focal length.
Result<LensDescription> CompleteLens(const LensFacts& facts, const std::string& where);

}  // namespace pleinair::scene
