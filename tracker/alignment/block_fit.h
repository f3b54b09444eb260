#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/alignment/motion_equations.h"
#include "tracker/alignment/print_raster.h"
#include "tracker/alignment/seen_window.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// A square of the print, in which light is taken as even.
struct PrintBlock {
  double correlation = 0.0;  ///< Normalised, of what is predicted and what is seen: -1…1.
  double gain = 0.0;         ///< Seen per share of white, in the picture's unit.
  double offset = 0.0;       ///< What black gives.
  double contrast = 0.0;     ///< Standard deviation of the predicted share of white.
  double noise = 0.0;        ///< Standard deviation of what is left over, in the picture's unit.
  double weight = 0.0;       ///< 0…1: how much the fit believes in it.
  int pixels = 0;
};

/// Which pixels a fit looks at.
enum class PrintPart {
  kBorder,  ///< Not the pattern's unknown modules.
  kWhole,
};

/// What a fit of a print to a picture varies.
struct BlockFitState {
  Mat3 modules_from_ideal;
  double blur_px = 0.6;  ///< Standard deviation beyond the pixel's square, in the picture's pixels.
};

struct BlockFitOptions {
  int steps = 4;
  bool fit_blur = false;
  /// Also the light's slope within blocks, and what is beyond a small print: to measure, not to
  /// find.
  bool fit_light = false;
  bool fit_projection = true;  ///< False: only the affine part of the motion.
  double robust_share = 0.35;  ///< Residual, in shares of white, at which a pixel loses half.
  /// What is seen is in shares of white already: no block has a gain or an offset of its own.
  bool known_light = false;
  bool tell_blocks = true;  ///< Which block each pixel belongs to is asked for afterwards.
  double done_px = 0.01;    ///< Stop when no corner moves farther, in the window's pixels.
};

/// Fits a print's homography to a picture by Gauss–Newton: the print's picture is predicted and
/// moved until it correlates with what is seen, block by block, each block with a gain and an
/// offset of its own, so that neither gradients nor edges of shadows across the print matter, and
/// robustly, so that what covers the print does not. (Normalised correlation by blocks is the
/// maximum-likelihood estimate when each block's light is unknown.)
class BlockFit {
 public:
  BlockFit();
  ~BlockFit();
  BlockFit(BlockFit&&) noexcept;
  BlockFit& operator=(BlockFit&&) noexcept;

  /// Blocks along each side of the print for a side this long: at least `block_px` each.
  static int BlocksAlong(double print_side_px, double block_px);

  /// False where the equations have no solution or the print leaves the window.
  bool Run(const PrintPattern& pattern, PrintPart part, const SeenWindow& seen, int blocks_along,
           const BlockFitOptions& options, BlockFitState* state);

  /// After Run, at the state it ended with or, where it stopped because nothing moved any more,
  /// less than `done_px` from there: row by row from the top-left.
  const std::vector<PrintBlock>& blocks() const { return blocks_; }
  int blocks_along() const { return blocks_along_; }
  /// Contrast of a block below which it tells nothing.
  double least_contrast() const { return least_contrast_; }
  const PrintMap& map() const { return map_; }
  const PrintPicture& picture() const { return picture_; }
  /// Block of each pixel of the window; -1: not of what is known of the print. A block's pixels
  /// come in squares of 2×2 or 4×4. Only after a Run with `tell_blocks`.
  const std::vector<std::int16_t>& block_of() const { return block_of_; }
  /// How much the fit believes in a pixel of the window that has a block, 0…1.
  float Belief(std::size_t pixel, const SeenWindow& seen) const {
    return seen.certainty[pixel] > 0.0F ? weight_[pixel] / seen.certainty[pixel] : 0.0F;
  }
  /// Noise of the quieter blocks in shares of white, as the last Run with unknown light found it.
  double noise_share() const { return noise_share_; }
  /// After Run: makes each pixel that counts as certain as the light that is predicted of it. A
  /// code's own certainty follows its noise, which biases a fit where there is much of it.
  void ExpectCertainty(SeenWindow* seen);
  /// Share-weighted correlation over all blocks that have contrast: 1 is perfect.
  double Correlation() const;
  /// Covariance of the eight motions (see block_fit_covariance.cc) from what is left over;
  /// row-major 8×8.
  std::array<double, 64> MotionCovariance() const;

  /// Predicts and compares without moving anything.
  void Evaluate(const PrintPattern& pattern, PrintPart part, const SeenWindow& seen,
                int blocks_along, const BlockFitState& state);

 private:
  static constexpr int kMostBlocksAlong = 8;
  static constexpr int kMostBlocks = kMostBlocksAlong * kMostBlocksAlong;
  static constexpr int kMotions = kFitMotions;
  static constexpr int kParameters = kFitParameters;

  struct Sums;  // What block_sums.h adds up; in block_fit_sums.h.
  void Start(const PrintPattern& pattern, const SeenWindow& seen, int blocks_along,
             const BlockFitState& state);
  void Predict(const PrintPattern& pattern, PrintPart part, const SeenWindow& seen,
               const BlockFitState& state);
  void FitLevels(const SeenWindow& seen, double robust_share, bool known_light);
  void AddUp(const SeenWindow& seen, const BlockFitOptions& options);
  /// Eliminates the light's slope from the equations, and what it is after a move.
  void EliminateSlope();
  void MoveSlope(const std::array<double, kParameters>& move);
  bool Move(const PrintPattern& pattern, const BlockFitOptions& options, double scale,
            BlockFitState* state, bool* done, bool* still);

  PrintRaster raster_;
  PrintMap map_;
  PrintPicture picture_;
  int blocks_along_ = 0;
  int tile_ = 4;
  int modules_ = 0, edge_modules_ = 0;
  double least_contrast_ = 0.0;
  double robust_share_ = 0.0;  ///< Residual, in shares of white, at which a pixel loses half.
  double noise_share_ = 0.0;   ///< First quartile of the blocks' noise, in shares of white.
  double blur_px_ = 0.0;       ///< In the picture's pixels, of the last prediction.
  std::vector<PrintBlock> blocks_;
  std::vector<double> noise_shares_;
  std::vector<std::int16_t> block_of_;
  std::vector<float> weight_;
  std::unique_ptr<Sums> sums_;
  MotionEquations equations_;
};

}  // namespace pleinair::tracker
