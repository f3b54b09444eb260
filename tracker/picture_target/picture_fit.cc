#include "tracker/picture_target/picture_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tracker/alignment/block_sums.h"
#include "tracker/alignment/light_elimination.h"
#include "tracker/picture_target/picture_target.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

constexpr int kMinBlocksAlong = 3, kMaxBlocksAlong = 12;
constexpr int kMinBlockPixels = 6;
constexpr double kDoubtfulCorrelation = 0.3, kCredibleCorrelation = 0.8;
constexpr float kMaxReach_modules =
    3.2F;  ///< A larger reach would exclude too many pixels of small targets.
/// Residual at which a pixel keeps a quarter of its weight: a multiple of the median residual of
/// matching blocks. It is limited to a range of standard deviations of the predicted light, and
/// from below by noise.
constexpr double kRobustShareOfRest = 3.0, kMaxRobustShare = 1.2, kMinRobustShare = 0.15;
constexpr double kMinRobust = 0.03;
/// Minimum detail of an informative block, in standard deviations of the noise.
constexpr double kTellingOverNoise = 1.5;
/// Minimum widths of blocks and of the target, in pixels, for tiles of 4×4 pixels.
constexpr double kMinBlockOfTiles_px = 7.0, kMinTargetOfTiles_px = 24.0;
constexpr double kDamping = 1e-7;

constexpr double kHalf = 0.5 * kTargetSide;
constexpr Mat3 kTargetFromUnit{{kHalf, 0, kHalf, 0, kHalf, kHalf, 0, 0, 1}};
constexpr Mat3 kUnitFromTarget{{1 / kHalf, 0, -1, 0, 1 / kHalf, -1, 0, 0, 1}};

SquareSides SidesOfTarget(const Mat3& target_from_undistorted) {
  return SidesOf(Adjugate(kUnitFromTarget * target_from_undistorted));
}

/// The side of a marker, as BlockSums requires it.
const MarkerPattern& SidePattern() {
  static const MarkerPattern kPattern{.modules = static_cast<int>(kTargetSide),
                                      .edge_modules = static_cast<int>(kTargetSide),
                                      .white = {}};
  return kPattern;
}

}  // namespace

struct PictureFit::Sums {
  BlockSums blocks;
  std::vector<RowRange> ranges;
  std::vector<BlockLight> lights;
  std::vector<LevelSums> levels;
  std::vector<BlockMotions> motions;
  FitProducts products;
};

PictureFit::PictureFit() : sums_(std::make_unique<Sums>()) {}
PictureFit::~PictureFit() = default;
PictureFit::PictureFit(PictureFit&&) noexcept = default;
PictureFit& PictureFit::operator=(PictureFit&&) noexcept = default;

int PictureFit::BlocksAlong(double area_px, double block_px) {
  return static_cast<int>(
      std::clamp(std::sqrt(area_px) / block_px, 1.0 * kMinBlocksAlong, 1.0 * kMaxBlocksAlong));
}

void PictureFit::Predict(const PicturePyramid& pyramid, const ObservedPatch& observed,
                         const PictureFitState& state) {
  const double blur = state.blur_px / observed.rays.window.Scale();
  raster_.Render(pyramid, state.target_from_undistorted, observed.rays, blur, &map_, &picture_,
                 &sums_->ranges);
  KnownPart known{};
  known.modules = static_cast<float>(kTargetSide);
  known.reach_px = static_cast<float>(0.5 + 1.3 * blur);
  known.max_reach_modules = kMaxReach_modules;
  known.unknown_half = -known.modules;  // The whole target is known.
  sums_->blocks.Lay(SidePattern(), known, observed, map_, sums_->ranges, tile_, blocks_along_);
}

void PictureFit::FitLevels(const ObservedPatch& observed, double min_weight) {
  sums_->blocks.Levels(observed, picture_, sums_->lights, &sums_->levels);
  rests_.clear();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const LevelSums& sum = sums_->levels[k];
    TargetBlock& block = blocks_[k];
    block = TargetBlock{};
    sums_->lights[k] = BlockLight{};
    block.pixels = static_cast<int>(std::lround(sum.pixels));
    if (block.pixels < kMinBlockPixels || !(sum.w > 0.0)) continue;
    const double p = sum.wp / sum.w, i = sum.wi / sum.w;
    const double vp = sum.wpp / sum.w - p * p, vi = sum.wii / sum.w - i * i;
    const double vpi = sum.wpi / sum.w - p * i;
    block.mean = p;
    block.observed = i;
    block.contrast = std::sqrt(std::max(0.0, vp));
    if (block.contrast < kMinContrast || !(vi > 1e-12)) continue;
    block.correlation = vpi / std::sqrt(vp * vi);
    if (!(sum.r > 0.0)) continue;
    const double rp = sum.rp / sum.r;
    const double rvp = sum.rpp / sum.r - rp * rp, rvpi = sum.rpi / sum.r - rp * (sum.ri / sum.r);
    if (!(rvp > 0.05 * vp)) continue;
    block.gain = rvpi / rvp;
    block.offset = (sum.ri - block.gain * sum.rp) / sum.r;
    if (!(block.gain > 0.0)) continue;
    block.weight = std::clamp(
        (block.correlation - kDoubtfulCorrelation) / (kCredibleCorrelation - kDoubtfulCorrelation),
        min_weight, 1.0);
    if (block.correlation > kDoubtfulCorrelation) {
      rests_.push_back(std::sqrt(1.0 - std::min(1.0, block.correlation * block.correlation)));
    }
  }
  double rest = 1.0;
  if (!rests_.empty()) {
    const auto middle = rests_.begin() + static_cast<std::ptrdiff_t>(rests_.size() / 2);
    std::nth_element(rests_.begin(), middle, rests_.end());
    rest = *middle;
  }
  const double share = std::clamp(kRobustShareOfRest * rest, kMinRobustShare, kMaxRobustShare);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const TargetBlock& block = blocks_[k];
    if (!(block.gain > 0.0)) continue;
    const double robust = std::max(share * block.contrast, kMinRobust);
    sums_->lights[k] = {static_cast<float>(block.gain), static_cast<float>(block.offset),
                        static_cast<float>(1.0 / (block.gain * robust)),
                        static_cast<float>(block.weight)};
  }
}

void PictureFit::AddUp(const ObservedPatch& observed, bool blur) {
  sums_->blocks.Motions(observed, picture_, sums_->lights, blur, &weight_, &sums_->products,
                        &sums_->motions);
  equations_ = MotionEquations(sums_->products);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (blocks_[k].weight > 0.0) equations_.EliminateLight(sums_->motions[k], blocks_[k].gain);
  }
  equations_.Mirror();
}

bool PictureFit::Move(const PictureFitOptions& options, double scale, PictureFitState* state,
                      bool* still) {
  const std::optional<MotionStep> step = SolveMotion(
      equations_,
      {.damping = kDamping, .fit_projection = options.fit_projection, .fit_blur = options.fit_blur},
      SidesOfTarget(state->target_from_undistorted).mean / scale);
  if (!step) return false;
  Mat3 moved = kTargetFromUnit *
               (step->BeforeFromAfter() * (kUnitFromTarget * state->target_from_undistorted));
  for (double& entry : moved.m) entry /= moved.m[8];
  for (const double entry : moved.m) {
    if (!std::isfinite(entry)) return false;
  }
  state->target_from_undistorted = moved;
  *still = step->moved_px < options.done_px;
  if (options.fit_blur) {
    const double blur = state->blur_px / scale, fitted = step->Blur(blur);
    *still = *still && std::fabs(fitted - blur) < kStillBlur_px;
    state->blur_px = fitted * scale;
  }
  return true;
}

bool PictureFit::Run(const PicturePyramid& pyramid, const ObservedPatch& observed, int blocks_along,
                     const PictureFitOptions& options, PictureFitState* state) {
  const double scale = observed.rays.window.Scale();
  blocks_along_ = std::clamp(blocks_along, 1, kMaxBlocksAlong);
  const std::size_t blocks = static_cast<std::size_t>(blocks_along_) * blocks_along_;
  blocks_.resize(blocks);
  sums_->lights.assign(blocks, BlockLight{});
  weight_ = observed.inverse_variance;
  const double shortest = SidesOfTarget(state->target_from_undistorted).shortest / scale;
  tile_ =
      shortest >= kMinTargetOfTiles_px && shortest / blocks_along_ >= kMinBlockOfTiles_px ? 4 : 2;
  for (int step = 0;; ++step) {
    Predict(pyramid, observed, *state);
    if (step == 0) FitLevels(observed, options.min_weight);
    // The light of the previous step (none in the first) determines the robust weights, and these
    // the light.
    FitLevels(observed, options.min_weight);
    AddUp(observed, options.fit_blur);
    if (step >= options.steps) return true;
    bool still = false;
    if (!Move(options, scale, state, &still)) return false;
    if (still) return true;
  }
}

void PictureFit::Compare(const ObservedPatch& observed) {
  block_of_.resize(observed.value.size());
  sums_->blocks.WriteBlocks(observed, &block_of_);
  details_.assign(blocks_.size(), {});
  const PixelWindow& window = observed.rays.window;
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * window.width + x;
      if (block_of_[at] < 0 || !(observed.inverse_variance[at] > 0.0F)) continue;
      // The lower triangle of v vᵀ, row by row.
      const std::array<double, 5> v{1.0, 1.0 * x, 1.0 * y, picture_.white[at], observed.value[at]};
      Detail& detail = details_[block_of_[at]];
      const double slope_x = picture_.white_x[at], slope_y = picture_.white_y[at];
      detail.slope_x += slope_x;
      detail.slope_y += slope_y;
      detail.slope2 += slope_x * slope_x + slope_y * slope_y;
      detail.inverse_variance += observed.inverse_variance[at];
      for (int a = 0, k = 0; a < 5; ++a) {
        for (int b = 0; b <= a; ++b, ++k) detail.products[k] += v[a] * v[b];
      }
    }
  }
  rests_.clear();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    TargetBlock& block = blocks_[k];
    Detail& detail = details_[k];
    block.detail_correlation = 0.0;
    block.informative = false;
    const double count = detail.products[0];
    if (count < kMinBlockPixels || !(block.mean > 0.0)) continue;
    Eigen::Matrix<double, 5, 5> products;
    for (int a = 0, at = 0; a < 5; ++a) {
      for (int b = 0; b <= a; ++b, ++at) products(a, b) = products(b, a) = detail.products[at];
    }
    // Partial correlation: the last two after removal of what the first three explain.
    const Eigen::Matrix<double, 2, 2> rest =
        products.bottomRightCorner<2, 2>() -
        products.bottomLeftCorner<2, 3>() *
            products.topLeftCorner<3, 3>().ldlt().solve(products.topRightCorner<3, 2>());
    if (!(rest(0, 0) > 1e-12 * count) || !(rest(1, 1) > 1e-14 * count)) continue;
    block.detail_correlation = rest(0, 1) / std::sqrt(rest(0, 0) * rest(1, 1));
    const double contrast = std::sqrt(rest(0, 0) / count);
    block.informative = contrast >= kMinContrast;
    // The mean square of the spatial frequency determines how far apart samples are independent.
    const double slope2 =
        detail.slope2 - (detail.slope_x * detail.slope_x + detail.slope_y * detail.slope_y) / count;
    block.samples = count * std::max(0.0, slope2) / rest(0, 0) / (4.0 * std::numbers::pi);
    const double codes = 255.0 * std::sqrt(detail.inverse_variance / count);
    // The light on the block is about the ratio of its observed to its predicted mean, also if it
    // is occluded.
    detail.contrast_codes = codes * contrast * block.observed / block.mean;
    detail.rest_codes =
        codes * std::sqrt(rest(1, 1) / count *
                          std::max(0.0, 1.0 - block.detail_correlation * block.detail_correlation));
    rests_.push_back(detail.rest_codes);
  }
  if (rests_.empty()) return;
  // Occluded blocks have large residuals; those of noise are equal everywhere.
  const auto low = rests_.begin() + static_cast<std::ptrdiff_t>(rests_.size() / 4);
  std::nth_element(rests_.begin(), low, rests_.end());
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    blocks_[k].informative =
        blocks_[k].informative && details_[k].contrast_codes >= kTellingOverNoise * *low;
  }
}

double PictureFit::Correlation() const {
  double sum = 0.0, share = 0.0;
  for (const TargetBlock& block : blocks_) {
    if (block.contrast < kMinContrast) continue;
    const double weight = block.pixels * block.contrast;
    sum += weight * block.correlation;
    share += weight;
  }
  return share > 0.0 ? sum / share : 0.0;
}

std::array<double, 64> PictureFit::MotionCovariance() const {
  double residual = 0.0, count = 0.0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const BlockMotions& sum = sums_->motions[k];
    const LightElimination eliminate(sum);
    if (!(blocks_[k].weight > 0.0) || !eliminate.possible) continue;
    residual += std::max(0.0, sum.rr - eliminate.OnPattern(sum.r, sum.rp) * sum.rp -
                                  eliminate.OnOne(sum.r, sum.rp) * sum.r);
    count += blocks_[k].pixels * blocks_[k].weight;
  }
  Eigen::Matrix<double, kMotions, kMotions> hessian =
      Eigen::Map<const Eigen::Matrix<double, kParameters, kParameters>>(equations_.hessian.data())
          .topLeftCorner<kMotions, kMotions>();
  const double variance = residual / std::max(1.0, count - kParameters);
  std::array<double, 64> covariance{};
  Eigen::Map<Eigen::Matrix<double, 8, 8, Eigen::RowMajor>> out(covariance.data());
  out = hessian.ldlt().solve(Eigen::Matrix<double, kMotions, kMotions>::Identity()) * variance;
  return covariance;
}

}  // namespace pleinair::tracker
