#pragma once

#include <filesystem>
#include <optional>

#include "base/vector.h"
#include "scene/lens_description.h"

namespace pleinair::scene {

/// What is known of the camera besides its calibration.
struct CameraDescription {
  /// File (devices/calibration/response_file.h), resolved against the folder of the file that names
  /// it; empty: sRGB.
  std::filesystem::path response;
  /// Overrides the exposure scale estimated on the marker.
  std::optional<LinearRgb> exposure_scale;
  std::optional<LensDescription> lens;           ///< As the user states it.
  std::optional<LensDescription> recorded_lens;  ///< As the recording's metadata state it.
};

}  // namespace pleinair::scene
