#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/alignment/motion_equations.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/picture_target/picture_pyramid.h"
#include "tracker/picture_target/picture_raster.h"

namespace pleinair::tracker {

/// A rectangle of the target, in which light is taken as even.
struct TargetBlock {
  double correlation = 0.0;  ///< Normalised, of what is predicted and what is observed: -1…1.
  double gain = 0.0;         ///< Linear light observed per light of the picture.
  double offset = 0.0;       ///< What black gives.
  double mean = 0.0;         ///< Predicted light, and what is observed, on average.
  double observed = 0.0;
  double contrast = 0.0;  ///< Standard deviation of the predicted light.
  double weight = 0.0;    ///< 0…1: how much the fit believes in it.
  int pixels = 0;
  /// After Compare: correlation of what no even slope explains, and whether there is enough of it
  /// to stand out from noise.
  double detail_correlation = 0.0;
  bool informative = false;
  /// Independent samples that there are of it, about: even blocks that are smooth agree by chance.
  double samples = 0.0;
};

/// What a fit varies.
struct PictureFitState {
  Mat3 target_from_undistorted;
  double blur_px = 0.7;  ///< Standard deviation beyond the pixel's square, in the picture's pixels.
};

struct PictureFitOptions {
  int steps = 5;
  bool fit_blur = false;
  bool fit_projection = true;  ///< False: only the affine part of the motion.
  /// Of a block that does not look as predicted: more than 0 where it may come to by moving.
  double min_weight = 0.0;
  double done_px = 0.02;  ///< Stop when no corner moves farther, in the window's pixels.
};

/// Fits a target's homography to a picture by Gauss–Newton, as BlockFit does for prints of modules:
/// the target's picture is predicted in linear light and moved until it correlates with what is
/// observed, each block with a gain and an offset of its own, so that neither gradients nor edges
/// of shadows across the target matter, and robustly, so that what covers it does not. What a pixel
/// may be off before it loses weight goes with the contrast of its block: pictures have weak parts.
class PictureFit {
 public:
  PictureFit();
  ~PictureFit();
  PictureFit(PictureFit&&) noexcept;
  PictureFit& operator=(PictureFit&&) noexcept;

  /// Blocks along each side of a target that covers so many pixels: of `block_px`² at least.
  static int BlocksAlong(double area_px, double block_px);

  /// False where the equations have no solution or the target leaves the window.
  bool Run(const PicturePyramid& pyramid, const ObservedPatch& observed, int blocks_along,
           const PictureFitOptions& options, PictureFitState* state);

  /// Compares the details of each block after Run. Any two smooth blocks correlate once one has
  /// been moved to where they do: what is like a plane is taken off both before.
  void Compare(const ObservedPatch& observed);

  /// After Run, at the state it ended with or less than `done_px` from there: row by row from the
  /// top-left.
  const std::vector<TargetBlock>& blocks() const { return blocks_; }
  int blocks_along() const { return blocks_along_; }
  /// Of all blocks that have contrast, weighted by it: 1 is perfect.
  double Correlation() const;
  /// Covariance of the eight motions (see .cc) from what is left over; row-major 8×8.
  std::array<double, 64> MotionCovariance() const;

  /// Least standard deviation of a block's predicted light for it to tell anything.
  static constexpr double kMinContrast = 0.01;

 private:
  static constexpr int kMotions = kFitMotions;
  static constexpr int kParameters = kFitParameters;

  struct Sums;
  void Predict(const PicturePyramid& pyramid, const ObservedPatch& observed,
               const PictureFitState& state);
  void FitLevels(const ObservedPatch& observed, double min_weight);
  void AddUp(const ObservedPatch& observed, bool blur);
  bool Move(const PictureFitOptions& options, double scale, PictureFitState* state, bool* still);

  PictureRaster raster_;
  PlaneMap map_;
  PredictedImage picture_;
  int blocks_along_ = 0;
  int tile_ = 4;
  std::vector<TargetBlock> blocks_;
  std::vector<float> weight_;
  std::vector<std::int16_t> block_of_;
  /// Of each block: sums of products, slopes, inverse variance; then how far details stand out from
  /// noise.
  struct Detail {
    std::array<double, 15> products{};
    double slope_x = 0.0, slope_y = 0.0, slope2 = 0.0;
    double inverse_variance = 0.0, contrast_codes = 0.0, rest_codes = 0.0;
  };
  std::vector<Detail> details_;
  std::vector<double> rests_;  ///< What is left over of each block that fits, of its contrast.
  std::unique_ptr<Sums> sums_;
  MotionEquations equations_;
};

}  // namespace pleinair::tracker
