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

/// An illumination block: a rectangle of the target in which gain and offset are constant.
struct TargetBlock {
  double correlation = 0.0;  ///< Normalised correlation of prediction and observation: -1…1.
  double gain = 0.0;         ///< Observed linear light per linear light of the target's image.
  double offset = 0.0;       ///< Observed value of black.
  double mean = 0.0;         ///< Means of predicted and of observed light.
  double observed = 0.0;
  double contrast = 0.0;  ///< Standard deviation of the predicted light.
  double weight = 0.0;    ///< Robust weight of the block, 0…1.
  int pixels = 0;
  /// After Compare(): correlation after removal of the best-fitting planes, and whether the
  /// remaining detail is well above noise.
  double detail_correlation = 0.0;
  bool informative = false;
  /// Approximate number of independent samples of the detail: smooth blocks may agree by chance.
  double samples = 0.0;
};

/// Parameters of a fit.
struct PictureFitState {
  Mat3 target_from_undistorted;
  double blur_px = 0.7;  ///< Standard deviation beyond the pixel's square, in pixels of the camera
                         ///< image.
};

struct PictureFitOptions {
  int steps = 5;
  bool fit_blur = false;
  bool fit_projection = true;  ///< False: only the affine part of the motion.
  /// Minimum weight of a block that does not match the prediction; above 0 if it may match after a
  /// move.
  double min_weight = 0.0;
  double done_px = 0.02;  ///< Stop when no corner moves farther than this, in pixels of the window.
};

/// Fits a target's homography to a camera image by Gauss–Newton, as BlockFit does for markers. It
/// predicts the target's image in linear light and moves it to maximise the correlation with the
/// observation. Each block has its own gain and offset, so that gradients and shadow edges do not
/// bias the fit. Robust weights reduce the influence of occluders; the residual at which a pixel
/// loses weight is proportional to the contrast of its block, because images have areas of low
/// contrast.
class PictureFit {
 public:
  PictureFit();
  ~PictureFit();
  PictureFit(PictureFit&&) noexcept;
  PictureFit& operator=(PictureFit&&) noexcept;

  /// Number of blocks along each side of a target of this area, so that a block has at least
  /// `block_px`² pixels.
  static int BlocksAlong(double area_px, double block_px);

  /// Returns false if the equations are singular or the target leaves the window.
  bool Run(const PicturePyramid& pyramid, const ObservedPatch& observed, int blocks_along,
           const PictureFitOptions& options, PictureFitState* state);

  /// Computes the detail correlation of each block after Run(). Two smooth blocks always correlate
  /// once one has been aligned to the other, so a plane is removed from both first.
  void Compare(const ObservedPatch& observed);

  /// Blocks of the last Run(), row by row from the top-left. Evaluated at the final state, or less
  /// than `done_px` from it.
  const std::vector<TargetBlock>& blocks() const { return blocks_; }
  int blocks_along() const { return blocks_along_; }
  /// Contrast-weighted mean correlation of all blocks with enough contrast; 1 is perfect.
  double Correlation() const;
  /// Covariance of the eight motion parameters (see .cc) from the residuals; row-major 8×8.
  std::array<double, 64> MotionCovariance() const;

  /// Minimum standard deviation of a block's predicted light for the block to be used.
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
  /// Per block: sums of products, slopes and inverse variance, then the ratio of detail to noise.
  struct Detail {
    std::array<double, 15> products{};
    double slope_x = 0.0, slope_y = 0.0, slope2 = 0.0;
    double inverse_variance = 0.0, contrast_codes = 0.0, rest_codes = 0.0;
  };
  std::vector<Detail> details_;
  std::vector<double> rests_;  ///< Residuals of each matching block, relative to its contrast.
  std::unique_ptr<Sums> sums_;
  MotionEquations equations_;
};

}  // namespace pleinair::tracker
