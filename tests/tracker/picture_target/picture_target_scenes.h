#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/image.h"
#include "tests/tracker/marker_rendering.h"
#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

/// A picture in linear light that can be placed in a scene and rendered.
class TestPicture {
 public:
  explicit TestPicture(Image<float> linear) : linear_(std::move(linear)) {}
  /// From sRGB pixel values.
  static TestPicture FromCodes(ImageView<const std::uint8_t> codes);

  int width() const { return linear_.width(); }
  int height() const { return linear_.height(); }
  double Aspect() const { return static_cast<double>(width()) / height(); }
  /// As 8-bit pixel values.
  GreyImage Codes() const;
  /// Interpolated at (0, 0) top-left … (1, 1) bottom-right.
  double LightAt(double u, double v) const;

 private:
  Image<float> linear_;
};

/// Overlapping shapes ("dead leaves"), each with its own grey level and grain, until the image is
/// covered. Sizes and contrasts are distributed as in photographs (Lee, Mumford, Huang, "Occlusion
/// models for natural images", 2001).
TestPicture DeadLeaves(std::uint32_t seed, int width, int height);

/// A picture in view.
struct HungPicture {
  const TestPicture* picture = nullptr;
  double width_m = 0.4;
  Transform<Camera, Marker> camera_from_marker;
  /// Light of an occluder at a point of the picture (0…1, right and down); negative where there is
  /// none.
  std::function<double(Vec2 at)> cover{};
  bool mirrored = false;

  double height_m() const { return width_m / picture->Aspect(); }
};

/// Placed so that its longer side would be `side_px` long without tilt (see PoseAtPixel).
HungPicture HangAt(const CameraModel& camera, const TestPicture& picture, Vec2 centre_px,
                   double side_px, double tilt_deg = 0.0, double axis_deg = 0.0,
                   double roll_deg = 0.0);

GreyImage RenderPictures(const CameraModel& camera, const std::vector<HungPicture>& pictures,
                         const RenderingOptions& options);

std::array<Vec2, 4> TrueCorners(const CameraModel& camera, const HungPicture& picture);

}  // namespace pleinair::tracker
