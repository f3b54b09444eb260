#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/surf/quantised_descriptor.h"

namespace pleinair::tracker {

/// The family that targets are reported as.
inline constexpr const char* kPictureFamily = "picture";

/// Places on a target, whatever its shape, are told in units in which it is a square of this side:
/// (0, 0) is its top-left corner, x goes right and y down.
inline constexpr double kTargetSide = 64.0;

/// An affine picture of a target: x = a u + b v + c, y = d u + e v + f in pixels, of (u, v) in
/// target units.
struct TargetView {
  std::array<double, 6> from_target{1, 0, 0, 0, 1, 0};  ///< a b c d e f.
};

/// A keypoint as one of the views shows it.
struct TargetKeypoint {
  int view = 0;
  float x = 0.0F, y = 0.0F;  ///< px of the view.
  float scale = 0.0F;        ///< SURF scale, px of the view.
  float angle_rad = 0.0F;    ///< Dominant direction in the view.
};

/// A picture that is looked for by its texture alone: no code, no rim.
struct PictureTarget {
  std::string name;
  double width_m = 0.0, height_m = 0.0;  ///< Of the picture as it is printed.
  GreyImage picture;                     ///< What is printed, sRGB codes, reduced.
  std::vector<TargetView> views;  ///< Tilts up to about 75° in all directions, near and far.
  std::vector<TargetKeypoint> keypoints;
  std::vector<QuantisedDescriptor> descriptors;  ///< One for each of `keypoints`.
};

/// Where a place in a view lies on the target, in target units.
Vec2 PlaceOnTarget(const TargetView& view, Vec2 in_view);
inline Vec2 PlaceOnTarget(const PictureTarget& target, const TargetKeypoint& keypoint) {
  return PlaceOnTarget(target.views[keypoint.view], {keypoint.x, keypoint.y});
}

// Bounds of what a target may hold, for those who make, write and read it.
inline constexpr int kMinTargetPicture_px = 32, kMaxTargetPicture_px = 512;
inline constexpr int kMaxTargetViews = 128, kMaxTargetKeypoints = 8192;
inline constexpr double kMinTargetSize_m = 0.001, kMaxTargetSize_m = 1000.0;
inline constexpr std::size_t kMaxTargetName = 200;  ///< Bytes.

}  // namespace pleinair::tracker
