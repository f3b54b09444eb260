#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/units.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// A print through a thin lens with a round stop, whose shutter is open for a while.
struct LensPicture {
  std::shared_ptr<const MarkerPattern> pattern;
  Metres size{0.2};  ///< Edge of the square with the reported corners.
  /// Pose at a share of the exposure, −0.5…0.5.
  std::function<Transform<Camera, Marker>(double share)> camera_from_marker;
  double aperture_m = 0.0, focus_dioptres = 0.0;
  double own_blur_px = 0.0;  ///< Standard deviation of a Gaussian beyond the pixel's box.
  double noise_codes = 0.0;  ///< Standard deviation of the added noise, in pixel values.
  double black = 0.04, white = 0.7, background = 0.25;  ///< Linear light.
  std::uint32_t seed = 1;
};

/// Casts 256 rays a pixel, each from its own place on the stop through its own place in the pixel,
/// at its own time. Exact for a plane: nothing of a disc or of layers is assumed.
GreyImage RenderThroughLens(const CameraModel& camera, const LensPicture& picture);

}  // namespace pleinair::tracker
