#include "tracker/surf_golay/sg_reading.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "tracker/pose/corner_covariance.h"
#include "tracker/pose/homography.h"
#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

constexpr double kMinInformativeShare = 0.15;  ///< Minimum share of blocks that count.
/// Corner error that no residual shows: flatness of the marker, calibration, non-Gaussian blur of
/// the lens.
constexpr double kSystematicCorner_px = 0.002;

/// Mean correlation of the blocks that do not touch the marker's edge, weighted by contrast.
double InnerCorrelation(const BlockFit& fit) {
  const int side = fit.blocks_along();
  double sum = 0.0, share = 0.0;
  for (int row = 1; row + 1 < side; ++row) {
    for (int column = 1; column + 1 < side; ++column) {
      const MarkerBlock& block = fit.blocks()[row * side + column];
      if (block.contrast <= fit.min_contrast()) continue;
      const double weight = block.pixels * block.contrast;
      sum += weight * block.correlation;
      share += weight;
    }
  }
  return share > 0.0 ? sum / share : 0.0;
}

/// A block in a uniform part of the marker is no evidence by itself: it takes the mean of the
/// informative blocks around it.
void JudgePlainBlocks(const BlockFit& fit, std::vector<float>* visible) {
  const std::vector<MarkerBlock>& blocks = fit.blocks();
  const int side = fit.blocks_along();
  const auto most = std::ranges::max_element(blocks, {}, &MarkerBlock::pixels);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const MarkerBlock& block = blocks[row * side + column];
      if (block.contrast > fit.min_contrast() || 2 * block.pixels < most->pixels) continue;
      float sum = 0.0F;
      int count = 0;
      for (int y = std::max(0, row - 1); y <= std::min(side - 1, row + 1); ++y) {
        for (int x = std::max(0, column - 1); x <= std::min(side - 1, column + 1); ++x) {
          if (blocks[y * side + x].contrast <= fit.min_contrast()) continue;
          sum += (*visible)[y * side + x];
          ++count;
        }
      }
      if (count > 0) (*visible)[row * side + column] = sum / static_cast<float>(count);
    }
  }
}

}  // namespace

void DescribeAppearance(const BlockFit& fit, SgReading* reading) {
  reading->whole_correlation = fit.Correlation();
  reading->inner_correlation = InnerCorrelation(fit);
  reading->blocks_along = fit.blocks_along();
  reading->visible.clear();
  double observed = 0.0, all = 0.0;
  for (const MarkerBlock& block : fit.blocks()) {
    // Blocks that clip completely, or lie outside the image, are no evidence.
    const bool informative = block.contrast > fit.min_contrast();
    const double visible =
        informative ? std::clamp((block.correlation - 0.4) / 0.4, 0.0, 1.0) : 0.0;
    reading->visible.push_back(static_cast<float>(visible));
    observed += visible;
    all += informative ? 1.0 : 0.0;
  }
  const double blocks = static_cast<double>(fit.blocks().size());
  reading->visible_fraction = observed / std::max(all, kMinInformativeShare * blocks);
  JudgePlainBlocks(fit, &reading->visible);
}

void DescribeFit(const LensGrid& lens, const BlockFit& fit, const BlockFitState& state,
                 SgReading* reading) {
  reading->modules_from_undistorted = state.modules_from_undistorted;
  reading->blur_px = state.blur_px;
  DescribeAppearance(fit, reading);
  reading->corners = CornersOfFit(lens, fit, state);
}

SgCorners CornersOfFit(const LensGrid& lens, const BlockFit& fit, const BlockFitState& state) {
  SgCorners told;
  // The corners in the fit's frame: the second axis of the plane points down.
  const Mat3 undistorted_from_modules = Adjugate(state.modules_from_undistorted);
  const auto pixel_of = [&](Vec2 unit_down) {
    return lens.PixelOfUndistorted(
        Apply(undistorted_from_modules, ModulesOfUnit({unit_down.x, -unit_down.y})));
  };
  std::array<FittedCorner, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = CornerAt({kSquareCorners[i].x, -kSquareCorners[i].y}, pixel_of);
    told.px[i] = corners[i].pixel;
  }
  told.covariance_px2 = CovarianceOfCorners(corners, fit.MotionCovariance(), kSystematicCorner_px);
  return told;
}

}  // namespace pleinair::tracker
