#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "scene/marker_reflectance.h"

namespace pleinair::compositor {

/// How a camera's picture looks beside a perfect one: what a drawn thing needs to sit in it.
struct CameraLook {
  /// Standard deviation of an edge's spread, pixels: lens, focus, motion and the pixel's own width
  /// (0.29) together.
  double blur_px = 0.0;
  /// Variance of linear light (1 = brightest) is constant + slope * light, a channel: read-out
  /// noise and photon noise. What rounding to 8 bits adds is not in it.
  std::array<double, 3> noise_constant{}, noise_slope{};
  double neighbour_correlation = 0.0;  ///< Of the noise of pixels side by side, 0…0.7.
  double channel_correlation = 0.0;    ///< Of the noise of two channels, 0…1.

  double NoiseSigma(int channel, double light) const;
};

/// Measures the look of one frame on the marker: the spread of the outer black square's edges, and
/// the noise of its black band and of the white around it, apart from where light or an occluder
/// changes. Nothing where the marker is too small (bands below five pixels) or mostly hidden.
std::optional<CameraLook> MeasureCameraLook(ImageView<const std::uint8_t> rgb,
                                            const CameraModel& camera,
                                            const Transform<Camera, Marker>& camera_from_marker,
                                            const scene::MarkerReflectance& marker,
                                            const CameraResponse& response);

}  // namespace pleinair::compositor
