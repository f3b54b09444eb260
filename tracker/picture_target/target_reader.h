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

/// A target that has been measured and looks as it should.
struct TargetReading {
  Mat3 target_from_undistorted;  ///< Homography from undistorted pixels to target units.
  double blur_px = 0.0;          ///< Standard deviation beyond the pixel's square.
  double correlation = 0.0;
  double visible_fraction = 0.0;  ///< Share of the target that looks as predicted.
  double evidence =
      0.0;  ///< Of its details: Σ -ln(1 - correlation²) of blocks that are not smooth.
  int blocks_along = 0;
  std::vector<float> visible;  ///< 0…1 for each block, row by row.
};

/// Measures a target at a guessed place and verifies that it is there: aligns it coarsely, then
/// finely on all its visible pixels, and compares what is predicted with what is observed, block by
/// block. Keeps its buffers; one thread at a time.
class TargetReader {
 public:
  explicit TargetReader(const LensGrid& lens) : lens_(lens) {}

  /// The picture that the following readings look at; kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey) { grey_ = grey; }

  /// From a guess that is right to some hundredths of the target's side. Nothing is returned where
  /// the target does not look as predicted.
  std::optional<TargetReading> Read(const PicturePyramid& pyramid, const PictureFitState& guess);

  /// Pixels of places on the target that make a square of `half_u` × `half_v` half sides, from the
  /// top-left clockwise, with their covariance; of the last reading.
  void Corners(const TargetReading& reading, double half_u, double half_v,
               std::array<Vec2, 4>* corners_px, CornerCovariance* covariance_px2) const;

 private:
  /// `max_px`: the picture is reduced until the target's longer side is no longer.
  bool TakeWindow(const Mat3& target_from_undistorted, double max_px,
                  ObservedPatch* observed) const;
  /// Fits with the target reduced to `max_px`; gives how much of it looks as predicted then.
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
