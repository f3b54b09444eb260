#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/surf/quantised_descriptor.h"

namespace pleinair::tracker {

/// Family name of image targets in reports.
inline constexpr const char* kPictureFamily = "picture";

/// Target units: coordinates in which a target, whatever its shape, is a square of this side. (0,
/// 0) is its top-left corner, x right, y down.
inline constexpr double kTargetSide = 64.0;

/// An affine view of a target: x = a u + b v + c, y = d u + e v + f in pixels, for (u, v) in target
/// units.
struct TargetView {
  std::array<double, 6> from_target{1, 0, 0, 0, 1, 0};  ///< a b c d e f.
};

/// A keypoint of one of the views.
struct TargetKeypoint {
  int view = 0;
  float x = 0.0F, y = 0.0F;  ///< Pixels of the view.
  float scale = 0.0F;        ///< SURF scale, pixels of the view.
  float angle_rad = 0.0F;    ///< Dominant direction in the view.
};

/// An image target: an image that is detected by its texture alone, without code or border.
struct PictureTarget {
  std::string name;
  double width_m = 0.0, height_m = 0.0;  ///< Size of the printed image.
  GreyImage picture;                     ///< The printed image, sRGB-encoded, reduced.
  std::vector<TargetView> views;         ///< Tilts up to about 75° in all directions, at several
                                         ///< distances.
  std::vector<TargetKeypoint> keypoints;
  std::vector<QuantisedDescriptor> descriptors;  ///< One for each of `keypoints`.
};

/// Target units of a point of a view.
Vec2 PlaceOnTarget(const TargetView& view, Vec2 in_view);
inline Vec2 PlaceOnTarget(const PictureTarget& target, const TargetKeypoint& keypoint) {
  return PlaceOnTarget(target.views[keypoint.view], {keypoint.x, keypoint.y});
}

// Limits of a target file's content, for writers and readers.
inline constexpr int kMinTargetPicture_px = 32, kMaxTargetPicture_px = 512;
inline constexpr int kMaxTargetViews = 128, kMaxTargetKeypoints = 8192;
inline constexpr double kMinTargetSize_m = 0.001, kMaxTargetSize_m = 1000.0;
inline constexpr std::size_t kMaxTargetName = 200;  ///< Bytes.

}  // namespace pleinair::tracker
