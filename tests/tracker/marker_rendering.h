#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "accuracy/marker_pose.h"
#include "base/camera_model.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/units.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// A print that stands in a rendered image.
struct RenderedMarker {
  std::shared_ptr<const MarkerPattern> pattern;
  Metres size{0.1};  ///< Edge of the square whose corners are reported.
  Transform<Camera, Marker> camera_from_marker;
  double black = 0.04, white = 0.8;  ///< Linear light.
  /// Light of what lies on the print at a point of it (half edges, x right, y up); negative where
  /// nothing does; nothing does where not given.
  std::function<double(Vec2 at)> cover{};
};

struct RenderingOptions {
  double background = 0.25;  ///< Linear light around the prints.
  double blur_px = 0.0;      ///< Standard deviation of the lens's Gaussian, beyond the pixel's box.
  double noise_codes = 0.0;  ///< Standard deviation of the noise added to the codes.
  std::uint32_t seed = 1;
  /// Light that falls on what a pixel sees; 1 where not given.
  std::function<double(Vec2 pixel)> light{};
  /// Light thrown back on top of that; none where not given.
  std::function<double(Vec2 pixel)> glare{};
};

/// Renders prints as a perfect camera with square pixels would see them: 12×12 samples a pixel
/// through the lens, averaged in linear light, encoded with the sRGB curve.
GreyImage RenderMarkers(const CameraModel& camera, const std::vector<RenderedMarker>& markers,
                        const RenderingOptions& options);

/// Where the corners (top-left, then clockwise as read) of a print really are.
std::array<Vec2, 4> TrueCorners(const CameraModel& camera, const RenderedMarker& marker);

using accuracy::PoseAtPixel;

}  // namespace pleinair::tracker
