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

/// A marker in a rendered image.
struct RenderedMarker {
  std::shared_ptr<const MarkerPattern> pattern;
  Metres size{0.1};  ///< Edge of the square with the reported corners.
  Transform<Camera, Marker> camera_from_marker;
  double black = 0.04, white = 0.8;  ///< Linear light.
  /// Light of an occluder at a point of the marker (half edges, x right, y up). Negative where
  /// there is none; empty: no occluder.
  std::function<double(Vec2 at)> cover{};
};

struct RenderingOptions {
  double background = 0.25;  ///< Linear light around the markers.
  double blur_px = 0.0;      ///< Standard deviation of the lens blur, beyond the pixel box.
  double noise_codes = 0.0;  ///< Standard deviation of the added noise, in pixel values.
  std::uint32_t seed = 1;
  /// Illumination factor at a pixel; empty: 1.
  std::function<double(Vec2 pixel)> light{};
  /// Light added by glare; empty: none.
  std::function<double(Vec2 pixel)> glare{};
};

/// Renders markers with a perfect camera with square pixels: 12×12 samples per pixel through the
/// lens. They are averaged in linear light and encoded with the sRGB curve.
GreyImage RenderMarkers(const CameraModel& camera, const std::vector<RenderedMarker>& markers,
                        const RenderingOptions& options);

/// True corners of a marker (top-left, then clockwise as read).
std::array<Vec2, 4> TrueCorners(const CameraModel& camera, const RenderedMarker& marker);

using accuracy::PoseAtPixel;

}  // namespace pleinair::tracker
