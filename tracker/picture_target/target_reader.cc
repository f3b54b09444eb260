#include "tracker/picture_target/target_reader.h"

#include <algorithm>
#include <cmath>

#include "tracker/picture_target/picture_target.h"
#include "tracker/pose/corner_covariance.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

/// Maximum side of a target in the coarse, the middle and the fine fit.
constexpr double kCoarseSide_px = 64.0, kMiddleSide_px = 160.0, kFineSide_px = 340.0;
constexpr int kMaxLevel = 5;
constexpr double kCoarseBlock_px = 9.0, kFineBlock_px = 12.0;
constexpr PictureFitOptions kCoarseFit{
    .steps = 8, .fit_projection = false, .min_weight = 0.02, .done_px = 0.1};
constexpr PictureFitOptions kMiddleFit{.steps = 8, .min_weight = 0.01, .done_px = 0.05};
constexpr PictureFitOptions kFineFit{.steps = 20, .fit_blur = true};
/// Blur assumed in reduced images, in their pixels.
constexpr double kReducedBlur_px = 1.0;
constexpr double kMinSide_px = 16.0;  ///< Minimum of the longer side; and of the shorter:
constexpr double kMinShort_px = 7.0;
constexpr std::size_t kMaxWindow = 400'000;
/// Visible share after the middle fit below which the fine fit is skipped; share from which on no
/// other fit is tried.
constexpr double kHopeless = 0.08, kGoodEnough = 0.9;
/// A block is occluded up to the first correlation and visible from the second on.
constexpr double kHidden = 0.4, kSeen = 0.8;
/// Minimum visible share of a detected target, and minimum product of that share and the evidence.
/// Images without the target reach 9. With it 30 is low: a target of 40 pixels, or with 60 %
/// occluded (docs/measurements/picture-targets.md).
constexpr double kMinVisible = 0.15, kMinEvidence = 15.0;
/// Number of a block's independent samples that the fit of motion and light explains anyway; number
/// beyond those at which the block's evidence counts in full.
constexpr double kFittedSamples = 3.0, kEnoughSamples = 8.0;
constexpr double kSurest = 0.995;              ///< Correlation that counts as 1.
constexpr double kMinInformativeShare = 0.15;  ///< Minimum share of blocks that count.
/// Corner error that no residual shows: flatness of the marker, its edges, calibration.
constexpr double kSystematicCorner_px = 0.02;
constexpr double kHalf = 0.5 * kTargetSide;

/// Longest and shortest side and area in undistorted pixels; nullopt where the horizon crosses the
/// target.
struct Extent {
  double longest = 0.0, shortest = 1e9;
  double area = 0.0;
};

std::optional<Extent> ExtentOf(const Mat3& target_from_undistorted) {
  const Mat3 inverse = Adjugate(target_from_undistorted);
  std::array<Vec2, 4> corners;
  double sign = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Vec3 corner = inverse * Vec3{kHalf + kHalf * kSquareCorners[i].x,
                                       kHalf - kHalf * kSquareCorners[i].y, 1.0};
    if (!(corner.z * sign > 0.0) && i > 0) return std::nullopt;
    sign = corner.z;
    corners[i] = {corner.x / corner.z, corner.y / corner.z};
  }
  Extent extent;
  for (int i = 0; i < 4; ++i) {
    const double side = Norm(corners[i] - corners[(i + 1) % 4]);
    if (!std::isfinite(side)) return std::nullopt;
    extent.longest = std::max(extent.longest, side);
    extent.shortest = std::min(extent.shortest, side);
    const Vec2 a = corners[i], b = corners[(i + 1) % 4];
    extent.area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  extent.area = std::fabs(extent.area);
  if (extent.longest < kMinSide_px || extent.shortest < kMinShort_px) return std::nullopt;
  return extent;
}

double VisibleOf(double correlation) {
  return std::clamp((correlation - kHidden) / (kSeen - kHidden), 0.0, 1.0);
}

/// Uninformative blocks take the visibility of the informative ones around them.
void FillIn(int along, std::vector<char>* known, std::vector<float>* visible) {
  for (bool missing = true, found = true; missing && found;) {
    missing = found = false;
    const std::vector<char> before = *known;
    for (int at = 0; at < along * along; ++at) {
      if (before[at] != 0) continue;
      missing = true;
      float sum = 0.0F, count = 0.0F;
      for (int y = std::max(0, at / along - 1); y <= std::min(along - 1, at / along + 1); ++y) {
        for (int x = std::max(0, at % along - 1); x <= std::min(along - 1, at % along + 1); ++x) {
          if (before[y * along + x] == 0) continue;
          sum += (*visible)[y * along + x];
          count += 1.0F;
        }
      }
      if (count == 0.0F) continue;
      (*visible)[at] = sum / count;
      (*known)[at] = 1;
      found = true;
    }
  }
}

}  // namespace

bool TargetReader::TakeWindow(const Mat3& target_from_undistorted, double max_px,
                              ObservedPatch* observed) const {
  const std::optional<Extent> extent = ExtentOf(target_from_undistorted);
  if (!extent) return false;
  int level = 0;
  while (level < kMaxLevel && extent->longest / (1 << level) > max_px &&
         extent->shortest / (1 << (level + 1)) > kMinShort_px) {
    ++level;
  }
  constexpr int kPlaces = 4;  // Along a side.
  constexpr int kMargin = 1;
  const std::optional<PixelWindow> window =
      WindowOfSquare(lens_, target_from_undistorted, kTargetSide, kPlaces, grey_.width(),
                     grey_.height(), level, kMargin);
  if (!window || window->width <= 3 || window->height <= 3 || window->size() > kMaxWindow) {
    return false;
  }
  TakeLinearWindow(lens_, grey_, *window, observed);
  return true;
}

double TargetReader::Fit(const PicturePyramid& pyramid, double max_px,
                         const PictureFitOptions& options, PictureFitState* state) {
  if (!TakeWindow(state->target_from_undistorted, max_px, &observed_)) return 0.0;
  const double scale = observed_.rays.window.Scale();
  const std::optional<Extent> extent = ExtentOf(state->target_from_undistorted);
  const double blur_px = state->blur_px;
  state->blur_px = std::max(blur_px, kReducedBlur_px * scale);
  const int blocks = PictureFit::BlocksAlong(extent->area / (scale * scale), kCoarseBlock_px);
  const bool fitted = fit_.Run(pyramid, observed_, blocks, options, state);
  state->blur_px = blur_px;
  if (!fitted) return 0.0;
  double visible = 0.0, all = 0.0;
  for (const TargetBlock& block : fit_.blocks()) {
    if (block.contrast < PictureFit::kMinContrast) continue;
    visible += block.gain > 0.0 ? VisibleOf(block.correlation) : 0.0;
    all += 1.0;
  }
  return visible / std::max(all, kMinInformativeShare * static_cast<double>(fit_.blocks().size()));
}

std::optional<TargetReading> TargetReader::Read(const PicturePyramid& pyramid,
                                                const PictureFitState& guess) {
  PictureFitState state = guess;
  double visible = Fit(pyramid, kMiddleSide_px, kMiddleFit, &state);
  if (visible < kGoodEnough) {
    // The guess is too far off, or an occluder is in front. A coarser image brings some guesses
    // closer and misleads others.
    PictureFitState other = guess;
    Fit(pyramid, kCoarseSide_px, kCoarseFit, &other);
    const double other_visible = Fit(pyramid, kMiddleSide_px, kMiddleFit, &other);
    if (other_visible > visible) {
      visible = other_visible;
      state = other;
    }
  }
  if (visible < kHopeless) return std::nullopt;
  return Measure(pyramid, state);
}

std::optional<TargetReading> TargetReader::Measure(const PicturePyramid& pyramid,
                                                   const PictureFitState& guess) {
  PictureFitState state = guess;
  if (!TakeWindow(state.target_from_undistorted, kFineSide_px, &observed_)) return std::nullopt;
  const double scale = observed_.rays.window.Scale();
  state.blur_px = std::max(state.blur_px, 0.5 * scale);
  const std::optional<Extent> extent = ExtentOf(state.target_from_undistorted);
  const int blocks = PictureFit::BlocksAlong(extent->area / (scale * scale), kFineBlock_px);
  if (!fit_.Run(pyramid, observed_, blocks, kFineFit, &state)) return std::nullopt;
  if (!ExtentOf(state.target_from_undistorted)) return std::nullopt;
  fit_.Compare(observed_);
  TargetReading reading;
  reading.target_from_undistorted = state.target_from_undistorted;
  reading.blur_px = state.blur_px;
  reading.correlation = fit_.Correlation();
  reading.blocks_along = fit_.blocks_along();
  std::vector<char> known;
  double observed = 0.0, all = 0.0;
  for (const TargetBlock& block : fit_.blocks()) {
    // Blocks that are uniform, clip completely, or are outside the image are no evidence.
    const double correlation =
        block.informative && block.gain > 0.0 ? block.detail_correlation : 0.0;
    const double visible = VisibleOf(correlation);
    reading.visible.push_back(static_cast<float>(visible));
    // Evidence against a chance correlation, in nats per pair of samples: -½ ln(1 - r²).
    const double sure = std::clamp(correlation, 0.0, kSurest);
    const double independent =
        std::clamp((block.samples - kFittedSamples) / kEnoughSamples, 0.0, 1.0);
    reading.evidence -= independent * std::log(1.0 - sure * sure);
    // A block outside the image is not observed, and its neighbours do not determine it either.
    known.push_back(block.informative || block.pixels == 0 ? 1 : 0);
    observed += visible;
    all += block.informative ? 1.0 : 0.0;
  }
  const double count = static_cast<double>(fit_.blocks().size());
  reading.visible_fraction = observed / std::max(all, kMinInformativeShare * count);
  FillIn(reading.blocks_along, &known, &reading.visible);
  if (!Verified(reading)) return std::nullopt;
  motion_covariance_ = fit_.MotionCovariance();
  return reading;
}

bool TargetReader::Verified(const TargetReading& reading) {
  return reading.visible_fraction >= kMinVisible &&
         reading.visible_fraction * reading.evidence >= kMinEvidence;
}

void TargetReader::Corners(const TargetReading& reading, double half_u, double half_v,
                           std::array<Vec2, 4>* corners_px,
                           CornerCovariance* covariance_px2) const {
  const Mat3 undistorted_from_target = Adjugate(reading.target_from_undistorted);
  const auto pixel_of = [&](Vec2 unit_down) {
    return lens_.PixelOfUndistorted(
        Apply(undistorted_from_target, {kHalf + kHalf * unit_down.x, kHalf + kHalf * unit_down.y}));
  };
  std::array<FittedCorner, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = CornerAt({half_u * kSquareCorners[i].x, -half_v * kSquareCorners[i].y}, pixel_of);
    (*corners_px)[i] = corners[i].pixel;
  }
  *covariance_px2 = CovarianceOfCorners(corners, motion_covariance_, kSystematicCorner_px);
}

}  // namespace pleinair::tracker
