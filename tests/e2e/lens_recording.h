#pragma once

#include <filesystem>
#include <string>

namespace pleinair::e2e {

/// A film of an S-G marker through a thin lens with an aperture of 12 mm, 320×240 pixels with a
/// focal length of 605. It comes from one distance to another, or sways sideways.
struct LensRecording {
  double farthest_m = 1.7, nearest_m = 0.6;
  double aperture_m = 0.012, focus_m = 1.1;
  double rate_hz = 2.0;
  int frames = 12;
  double sway_px = 0.0, sways_hz = 0.8;  ///< Amplitude and frequency.
  double exposure_s = 0.0;
  std::string more = {};  ///< Further text of recording.json.
};

/// Writes its folder, with a scene that has a box to draw.
void WriteLensRecording(const std::filesystem::path& folder, const LensRecording& how);

}  // namespace pleinair::e2e
