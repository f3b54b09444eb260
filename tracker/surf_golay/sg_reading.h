#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <optional>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/lens_grid.h"

namespace pleinair::tracker {

/// Corners of a marker in an image, with their covariance.
struct SgCorners {
  std::array<Vec2, 4> px;  ///< Clockwise from top-left on the upright marker.
  std::array<double, 64> covariance_px2{};
};

/// An S-G marker that has been decoded, measured and verified.
struct SgReading {
  int number = 0;
  Mat3 modules_from_undistorted;  ///< Homography from undistorted pixels to modules of the marker.
  double blur_px = 0.0;           ///< Standard deviation beyond the pixel's square.
  SgCorners corners;
  /// Replacement for `corners` in noisy images, from a further fit. Reported only; all decisions
  /// about the reading use its other members.
  std::optional<SgCorners> corners_through_noise;
  double visible_fraction = 0.0;  ///< Share of the marker that matches the prediction.
  double whole_correlation = 0.0;
  double inner_correlation = 0.0;  ///< Correlation of the blocks that do not touch the marker's
                                   ///< edge.
  float margin = 0.0F;             ///< Decision margin over the second number (SoftGolayDecoding).
  double confidence_bits = 0.0;    ///< Evidence of the cells beyond the bits to select one of the
                                   ///< numbers in use.
  int blocks_along = 0;
  std::vector<float> visible;  ///< 0…1 for each block of the marker, row by row.
};

/// Stores the result of a fit of the whole marker: position, covariance, match with the prediction,
/// visibility. Not the number, its margin and its confidence.
void DescribeFit(const LensGrid& lens, const BlockFit& fit, const BlockFitState& state,
                 SgReading* reading);

/// Corners from a fit of the whole marker.
SgCorners CornersOfFit(const LensGrid& lens, const BlockFit& fit, const BlockFitState& state);

/// Stores only the match with the prediction and the visibility.
void DescribeAppearance(const BlockFit& fit, SgReading* reading);

}  // namespace pleinair::tracker
