#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/picture_target/picture_fit.h"
#include "tracker/picture_target/picture_pyramid.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::tracker {

/// A target that has been measured and verified.
struct TargetReading {
  Mat3 target_from_undistorted;  ///< Homography from undistorted pixels to target units.
  double blur_px = 0.0;          ///< Standard deviation beyond the pixel's square.
  double correlation = 0.0;
  double visible_fraction = 0.0;  ///< Share of the target that matches the prediction.
  double evidence =
      0.0;  ///< Σ -ln(1 - correlation²) over the details of blocks that are not smooth.
  int blocks_along = 0;
  std::vector<float> visible;  ///< 0…1 for each block, row by row.
};

/// Measures a target near an initial guess and verifies it: aligns it coarsely, then finely on all
/// visible pixels, and compares prediction and observation block by block. Reuses its buffers; one
/// thread at a time.
class TargetReader {
 public:
  explicit TargetReader(const LensGrid& lens) : lens_(lens) {}

  /// Image for the following readings; kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey) { grey_ = grey; }

  /// Reads a target from a guess that is accurate to a few hundredths of the target's side. Returns
  /// nullopt if the target does not match the prediction.
  std::optional<TargetReading> Read(const PicturePyramid& pyramid, const PictureFitState& guess);

  /// Pixels of the corners of a rectangle around the target's centre with half sides `half_u` ×
  /// `half_v`, clockwise from the top-left, with their covariance; of the last reading.
  void Corners(const TargetReading& reading, double half_u, double half_v,
               std::array<Vec2, 4>* corners_px, CornerCovariance* covariance_px2) const;

 private:
  /// `max_px`: the image is reduced until the target's longer side is at most this long.
  bool TakeWindow(const Mat3& target_from_undistorted, double max_px,
                  ObservedPatch* observed) const;
  /// Fits with the target reduced to `max_px`; returns the share of it that then matches the
  /// prediction.
  double Fit(const PicturePyramid& pyramid, double max_px, const PictureFitOptions& options,
             PictureFitState* state);
  std::optional<TargetReading> Measure(const PicturePyramid& pyramid, const PictureFitState& guess);
  static bool Verified(const TargetReading& reading);

  const LensGrid& lens_;
  ImageView<const std::uint8_t> grey_;
  ObservedPatch observed_;
  PictureFit fit_;
  std::array<double, 64> motion_covariance_{};
};

}  // namespace pleinair::tracker
