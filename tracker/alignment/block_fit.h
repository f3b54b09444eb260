#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/alignment/motion_equations.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// A square of the marker, in which light is taken as even.
struct MarkerBlock {
  double correlation = 0.0;  ///< Normalised, of what is predicted and what is observed: -1…1.
  double gain = 0.0;         ///< Seen per share of white, in the image's unit.
  double offset = 0.0;       ///< What black gives.
  double contrast = 0.0;     ///< Standard deviation of the predicted share of white.
  double noise = 0.0;        ///< Standard deviation of what is left over, in the image's unit.
  double weight = 0.0;       ///< 0…1: how much the fit believes in it.
  int pixels = 0;
};

/// Which pixels a fit looks at.
enum class MarkerPart {
  kBorder,  ///< Not the pattern's unknown modules.
  kWhole,
};

/// What a fit of a marker to an image varies.
struct BlockFitState {
  Mat3 modules_from_undistorted;
  double blur_px = 0.6;  ///< Standard deviation beyond the pixel's square, in the image's pixels.
};

struct BlockFitOptions {
  int steps = 4;
  bool fit_blur = false;
  /// Also the light's slope within blocks, and what is beyond a small marker: to measure, not to
  /// find.
  bool fit_light = false;
  bool fit_projection = true;  ///< False: only the affine part of the motion.
  double robust_share = 0.35;  ///< Residual, in shares of white, at which a pixel loses half.
  /// What is observed is in shares of white already: no block has a gain or an offset of its own.
  bool known_light = false;
  bool label_blocks = true;  ///< Which block each pixel belongs to is asked for afterwards.
  double done_px = 0.01;     ///< Stop when no corner moves farther, in the window's pixels.
};

/// Fits a marker's homography to an image by Gauss–Newton: the marker's image is predicted and
/// moved until it correlates with what is observed, block by block, each block with a gain and an
/// offset of its own, so that neither gradients nor edges of shadows across the marker matter, and
/// robustly, so that what covers the marker does not. (Normalised correlation by blocks is the
/// maximum-likelihood estimate when each block's light is unknown.)
class BlockFit {
 public:
  BlockFit();
  ~BlockFit();
  BlockFit(BlockFit&&) noexcept;
  BlockFit& operator=(BlockFit&&) noexcept;

  /// Blocks along each side of the marker for a side this long: at least `block_px` each.
  static int BlocksAlong(double marker_side_px, double block_px);

  /// False where the equations have no solution or the marker leaves the window.
  bool Run(const MarkerPattern& pattern, MarkerPart part, const ObservedPatch& observed,
           int blocks_along, const BlockFitOptions& options, BlockFitState* state);

  /// After Run, at the state it ended with or, where it stopped because nothing moved any more,
  /// less than `done_px` from there: row by row from the top-left.
  const std::vector<MarkerBlock>& blocks() const { return blocks_; }
  int blocks_along() const { return grid_.blocks_along; }
  /// Contrast of a block below which it tells nothing.
  double min_contrast() const { return min_contrast_; }
  const PlaneMap& map() const { return map_; }
  const PredictedImage& image() const { return image_; }
  /// Block of each pixel of the window; -1: not of what is known of the marker. A block's pixels
  /// come in squares of 2×2 or 4×4. Only after a Run with `label_blocks`.
  const std::vector<std::int16_t>& block_of() const { return block_of_; }
  /// How much the fit believes in a pixel of the window that has a block, 0…1.
  float RobustWeightOf(std::size_t pixel, const ObservedPatch& observed) const {
    return observed.inverse_variance[pixel] > 0.0F
               ? weight_[pixel] / observed.inverse_variance[pixel]
               : 0.0F;
  }
  /// Noise of the quieter blocks in shares of white, as the last Run with unknown light found it.
  double noise_share() const { return robustness_.noise_share; }
  /// After Run: makes each pixel that counts as certain as the light that is predicted of it. A
  /// code's own inverse variance follows its noise, which biases a fit where there is much of it.
  void UsePredictedVariance(ObservedPatch* observed);
  /// Share-weighted correlation over all blocks that have contrast: 1 is perfect.
  double Correlation() const;
  /// Covariance of the eight motions (see block_fit_covariance.cc) from what is left over;
  /// row-major 8×8.
  std::array<double, 64> MotionCovariance() const;

  /// Predicts and compares without moving anything.
  void Evaluate(const MarkerPattern& pattern, MarkerPart part, const ObservedPatch& observed,
                int blocks_along, const BlockFitState& state);

 private:
  static constexpr int kMaxBlocksAlong = 8;
  static constexpr int kMaxBlocks = kMaxBlocksAlong * kMaxBlocksAlong;
  static constexpr int kMotions = kFitMotions;
  static constexpr int kParameters = kFitParameters;

  /// How the marker is cut into blocks, and the window into tiles.
  struct Grid {
    int blocks_along = 0;
    int tile_px = 4;
    int modules = 0, edge_modules = 0;  ///< As in MarkerPattern.
  };
  /// From which residual on a pixel is taken for covered, and the noise that says so.
  struct Robustness {
    double share = 0.0;        ///< Residual, in shares of white, at which a pixel loses half.
    double noise_share = 0.0;  ///< First quartile of the blocks' noise, in shares of white.
    std::vector<double> noise_shares;  ///< Of the blocks.
  };
  struct Sums;  // What block_sums.h adds up; in block_fit_sums.h.
  void Start(const MarkerPattern& pattern, const ObservedPatch& observed, int blocks_along,
             const BlockFitState& state);
  void Predict(const MarkerPattern& pattern, MarkerPart part, const ObservedPatch& observed,
               const BlockFitState& state);
  void FitLevels(const ObservedPatch& observed, double robust_share, bool known_light);
  void AddUp(const ObservedPatch& observed, const BlockFitOptions& options);
  /// Eliminates the light's slope from the equations, and what it is after a move.
  void EliminateSlope();
  void MoveSlope(const std::array<double, kParameters>& move);
  bool Move(const MarkerPattern& pattern, const BlockFitOptions& options, double scale,
            BlockFitState* state, bool* done, bool* still);

  MarkerRaster raster_;
  PlaneMap map_;
  PredictedImage image_;
  Grid grid_;
  double min_contrast_ = 0.0;
  Robustness robustness_;
  double blur_px_ = 0.0;  ///< In the image's pixels, of the last prediction.
  std::vector<MarkerBlock> blocks_;
  std::vector<std::int16_t> block_of_;
  std::vector<float> weight_;
  std::unique_ptr<Sums> sums_;
  MotionEquations equations_;
};

}  // namespace pleinair::tracker
