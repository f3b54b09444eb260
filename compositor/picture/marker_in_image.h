#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "scene/marker_reflectance.h"

namespace pleinair::compositor {

/// The marker in one frame: the pixel positions of its points, and the linear light there (1 =
/// brightest). Keeps references to the constructor's arguments, which must outlive it.
class MarkerInImage {
 public:
  MarkerInImage(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
                const Transform<Camera, Marker>& camera_from_marker,
                const scene::MarkerReflectance& marker, const CameraResponse& response)
      : rgb_(rgb),
        camera_(camera),
        camera_from_marker_(camera_from_marker),
        marker_(marker),
        response_(response) {}

  ImageView<const std::uint8_t> rgb() const { return rgb_; }
  const CameraModel& camera() const { return camera_; }
  const Transform<Camera, Marker>& camera_from_marker() const { return camera_from_marker_; }
  const scene::MarkerReflectance& marker() const { return marker_; }

  /// Width of the white around the outer black square, metres.
  double white_m() const {
    const double margin_m = (marker_.board_size_m - marker_.size_m) / 2;
    return margin_m > 0.0 ? margin_m : marker_.black_band_m;
  }

  /// Projects a point on the marker (marker coordinates, metres). Returns nothing where it lies
  /// behind the camera.
  std::optional<Vec2> PixelOf(Vec2 on_marker) const {
    const Point<Camera> p = camera_from_marker_ * Point<Marker>{{on_marker.x, on_marker.y, 0.0}};
    if (p.xyz.z <= 0.0) return std::nullopt;
    return ProjectToPixel(camera_, p);
  }
  bool IsInside(int x, int y) const {
    return x >= 0 && y >= 0 && x < rgb_.width() && y < rgb_.height();
  }
  /// True if one of the first `channels` of a pixel is clipped.
  bool IsClipped(int x, int y, int channels) const {
    for (int c = 0; c < channels; ++c) {
      if (rgb_(x, y, c) >= kClipped) return true;
    }
    return false;
  }
  double Light(int x, int y, int c) const { return response_.Linear(c)[rgb_(x, y, c)]; }
  double Grey(int x, int y) const { return (Light(x, y, 0) + Light(x, y, 1) + Light(x, y, 2)) / 3; }

  /// Variance of rounding to 8-bit pixel values: a twelfth of a step squared.
  double RoundingAt(int c, double light) const {
    const auto& table = response_.Linear(c);
    const auto above = std::upper_bound(table.begin(), table.end(), static_cast<float>(light));
    const auto code = std::clamp<std::ptrdiff_t>(above - table.begin(), 1, 255);
    const double step = table[code] - table[code - 1];
    return step * step / 12;
  }

 private:
  static constexpr int kClipped = 250;

  ImageView<const std::uint8_t> rgb_;
  const CameraModel& camera_;
  const Transform<Camera, Marker>& camera_from_marker_;
  const scene::MarkerReflectance& marker_;
  const CameraResponse& response_;
};

}  // namespace pleinair::compositor
