#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "compositor/lens/camera_motion.h"
#include "compositor/lens/thin_lens.h"
#include "scene/marker_reflectance.h"

namespace pleinair::compositor {

/// Sensor noise and blur of a camera image. Drawn objects need both to match the image.
struct CameraLook {
  /// Standard deviation of the edge spread, pixels. It includes lens, focus, motion and the pixel's
  /// own width (0.29).
  double blur_px = 0.0;
  /// Variance of linear light (1 = brightest) is constant + slope * light, per channel: read-out
  /// noise and photon noise. Rounding to 8 bits is not included.
  std::array<double, 3> noise_constant{}, noise_slope{};
  double neighbour_correlation = 0.0;  ///< Noise correlation of adjacent pixels, 0…0.7.
  double channel_correlation = 0.0;    ///< Noise correlation of two channels, 0…1.

  double NoiseSigma(int channel, double light) const;
};

/// Measures the look of one frame on the marker. Blur comes from the edges of the outer black
/// square, noise from its black band and the white around it. Places where the light changes or an
/// occluder lies are omitted. Returns nothing where the marker is too small (bands below five
/// pixels) or mostly hidden. With a lens, the blur is that in focus: what remains beside the circle
/// of confusion of each side. With a motion, it is that at rest, too.
std::optional<CameraLook> MeasureCameraLook(ImageView<const std::uint8_t> rgb,
                                            const CameraModel& camera,
                                            const Transform<Camera, Marker>& camera_from_marker,
                                            const scene::MarkerReflectance& marker,
                                            const CameraResponse& response,
                                            const std::optional<ThinLens>& lens = {},
                                            const CameraMotion& motion = {});

}  // namespace pleinair::compositor
