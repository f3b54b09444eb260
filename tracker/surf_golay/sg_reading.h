#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <optional>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/lens_grid.h"

namespace pleinair::tracker {

/// Corners of a marker in an image and how sure they are.
struct SgCorners {
  std::array<Vec2, 4> px;  ///< Top-left, then clockwise as the marker is read.
  std::array<double, 64> covariance_px2{};
};

/// An S-G marker that has been read, measured and verified.
struct SgReading {
  int number = 0;
  Mat3 modules_from_undistorted;  ///< Homography from undistorted pixels to modules of the marker.
  double blur_px = 0.0;           ///< Standard deviation beyond the pixel's square.
  SgCorners corners;
  /// As `corners` where pixels are noisy, by a further fit. To be told: all that is decided about a
  /// reading is decided by what else it says.
  std::optional<SgCorners> corners_through_noise;
  double visible_fraction = 0.0;  ///< Share of the marker that looks as predicted.
  double whole_correlation = 0.0;
  double inner_correlation = 0.0;  ///< Of the blocks that do not touch the marker's edge.
  float margin = 0.0F;             ///< Of the number over the next likely one (SoftGolayDecoding).
  double confidence_bits = 0.0;  ///< What the cells tell beyond picking one of the numbers in use.
  int blocks_along = 0;
  std::vector<float> visible;  ///< 0…1 for each block of the marker, row by row.
};

/// Writes down what a fit of the whole marker tells: where it lies and how sure that is, how well
/// it looks as predicted and where it is observed. Not the number, its margin and its proof.
void DescribeFit(const LensGrid& lens, const BlockFit& fit, const BlockFitState& state,
                 SgReading* reading);

/// Where a fit of the whole marker puts its corners.
SgCorners CornersOfFit(const LensGrid& lens, const BlockFit& fit, const BlockFitState& state);

/// Writes down only how well the whole marker looks as predicted and where it is observed.
void DescribeAppearance(const BlockFit& fit, SgReading* reading);

}  // namespace pleinair::tracker
