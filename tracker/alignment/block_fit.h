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

/// An illumination block: a square of the marker in which gain and offset are constant.
struct MarkerBlock {
  double correlation = 0.0;  ///< Normalised correlation of prediction and observation: -1…1.
  double gain = 0.0;         ///< Observed value per share of white, in the image's unit.
  double offset = 0.0;       ///< Observed value of black, in the image's unit.
  double contrast = 0.0;     ///< Standard deviation of the predicted share of white.
  double noise = 0.0;        ///< Standard deviation of the residuals, in the image's unit.
  double weight = 0.0;       ///< Robust weight of the block, 0…1.
  int pixels = 0;
};

/// Modules of the marker that a fit uses.
enum class MarkerPart {
  kBorder,  ///< All but the modules that differ from marker to marker.
  kWhole,
};

/// Parameters of a fit of a marker to an image.
struct BlockFitState {
  Mat3 modules_from_undistorted;
  double blur_px = 0.6;  ///< Standard deviation beyond the pixel's square, in image pixels.
};

struct BlockFitOptions {
  int steps = 4;
  bool fit_blur = false;
  /// Also fit a gradient of the light within blocks, and model what surrounds a small marker.
  /// Needed to measure a marker, not to find it.
  bool fit_light = false;
  bool fit_projection = true;  ///< False: only the affine part of the motion.
  double robust_share = 0.35;  ///< Residual, in shares of white, at which a pixel's weight is ½.
  /// The observation is in shares of white already: blocks have no gain or offset of their own.
  bool known_light = false;
  bool label_blocks = true;  ///< Store the block of each pixel for block_of().
  double done_px = 0.01;  ///< Stop when no corner moves farther than this, in pixels of the window.
};

/// Fits a marker's homography to an image by Gauss–Newton: it predicts the marker's image and moves
/// it to maximise the correlation with the observation. Each illumination block has its own gain
/// and offset, so that gradients and shadow edges across the marker do not bias the fit. Robust
/// weights reduce the influence of occluders. (The sum of normalised correlations over blocks is
/// the maximum-likelihood estimate when each block's gain and offset are unknown.)
class BlockFit {
 public:
  BlockFit();
  ~BlockFit();
  BlockFit(BlockFit&&) noexcept;
  BlockFit& operator=(BlockFit&&) noexcept;

  /// Number of blocks along a marker side of this length, so that a block has at least `block_px`.
  static int BlocksAlong(double marker_side_px, double block_px);

  /// Returns false if the equations are singular or the marker leaves the window.
  bool Run(const MarkerPattern& pattern, MarkerPart part, const ObservedPatch& observed,
           int blocks_along, const BlockFitOptions& options, BlockFitState* state);

  /// Blocks of the last Run(), row by row from the top-left. Evaluated at the final state, or less
  /// than `done_px` from it if the fit converged.
  const std::vector<MarkerBlock>& blocks() const { return blocks_; }
  int blocks_along() const { return grid_.blocks_along; }
  /// Minimum contrast of a block that is used.
  double min_contrast() const { return min_contrast_; }
  const PlaneMap& map() const { return map_; }
  const PredictedImage& image() const { return image_; }
  /// Block of each pixel of the window; -1: not on a known part of the marker. A block's pixels
  /// come in squares of 2×2 or 4×4. Only after a Run() with `label_blocks`.
  const std::vector<std::int16_t>& block_of() const { return block_of_; }
  /// Robust weight, 0…1, of a pixel of the window that belongs to a block.
  float RobustWeightOf(std::size_t pixel, const ObservedPatch& observed) const {
    return observed.inverse_variance[pixel] > 0.0F
               ? weight_[pixel] / observed.inverse_variance[pixel]
               : 0.0F;
  }
  /// Noise of the quieter blocks in shares of white, from the last Run() without `known_light`.
  double noise_share() const { return robustness_.noise_share; }
  /// After Run(): replaces the inverse variance of each used pixel by that of its predicted light.
  /// The inverse variance of the observed value follows its noise, which biases a fit of a noisy
  /// image.
  void UsePredictedVariance(ObservedPatch* observed);
  /// Contrast-weighted correlation over all blocks with enough contrast; 1 is perfect.
  double Correlation() const;
  /// Covariance of the eight motion parameters (see block_fit_covariance.cc) from the residuals;
  /// row-major 8×8.
  std::array<double, 64> MotionCovariance() const;

  /// Predicts and compares without moving the marker.
  void Evaluate(const MarkerPattern& pattern, MarkerPart part, const ObservedPatch& observed,
                int blocks_along, const BlockFitState& state);

 private:
  static constexpr int kMaxBlocksAlong = 8;
  static constexpr int kMaxBlocks = kMaxBlocksAlong * kMaxBlocksAlong;
  static constexpr int kMotions = kFitMotions;
  static constexpr int kParameters = kFitParameters;

  /// Division of the marker into blocks, and of the window into tiles.
  struct Grid {
    int blocks_along = 0;
    int tile_px = 4;
    int modules = 0, edge_modules = 0;  ///< As in MarkerPattern.
  };
  /// Residual from which a pixel counts as occluded, and the noise from which it is derived.
  struct Robustness {
    double share = 0.0;        ///< Residual, in shares of white, at which a pixel's weight is ½.
    double noise_share = 0.0;  ///< First quartile of the blocks' noise, in shares of white.
    std::vector<double> noise_shares;  ///< One per block.
  };
  struct Sums;  // The sums of block_sums.h; defined in block_fit_sums.h.
  void Start(const MarkerPattern& pattern, const ObservedPatch& observed, int blocks_along,
             const BlockFitState& state);
  void Predict(const MarkerPattern& pattern, MarkerPart part, const ObservedPatch& observed,
               const BlockFitState& state);
  void FitLevels(const ObservedPatch& observed, double robust_share, bool known_light);
  void AddUp(const ObservedPatch& observed, const BlockFitOptions& options);
  /// Eliminates the light's gradient from the equations; MoveSlope() updates it after a move.
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
  double blur_px_ = 0.0;  ///< Blur of the last prediction, in image pixels.
  std::vector<MarkerBlock> blocks_;
  std::vector<std::int16_t> block_of_;
  std::vector<float> weight_;
  std::unique_ptr<Sums> sums_;
  MotionEquations equations_;
};

}  // namespace pleinair::tracker
