#include "tracker/alignment/block_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tracker/alignment/block_fit_sums.h"
#include "tracker/alignment/surroundings.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

/// Minimum standard deviation of the share of white. Where much of the window is clipped only the
/// foot of each edge is left, although it is steep.
constexpr double kMinBlockContrast = 0.04, kMinClippedContrast = 0.012, kMuchClipped = 0.25;
constexpr float kClippedLight = 0.9F;  ///< Pixels excluded for other reasons are darker.
constexpr int kMinBlockPixels = 6;
constexpr double kMinWeight = 0.02;
constexpr double kRobustNoises = 1.0;  ///< Standard deviations at which a pixel's weight is ½.
constexpr double kDoubtfulCorrelation = 0.3, kCredibleCorrelation = 0.8;
constexpr float kMaxReach_modules = 2.4F;
/// Noise does not make a pixel brighter than predicted by this many whites.
constexpr float kFarBrighter = 2.0F;
constexpr double kDamping = 1e-5;
/// Logarithm of light per half edge; and minimum independence of the two slopes.
constexpr double kMaxSlope = 3.0, kMinSlopeDeterminant = 1e-3;
/// Correlation of an unoccluded marker: on others an occluder would be mistaken for a gradient.
constexpr double kPlainCorrelation = 0.9;
/// Tiles of 4×4 pixels if blocks and marker have at least these widths in pixels.
constexpr double kMinBlockOfTiles_px = 7.0, kMinMarkerOfTiles_px = 24.0;

/// From half edges around the marker's centre, y down, to modules from its top-left corner.
Mat3 ModulesFromUnit(const MarkerPattern& pattern) {
  const double half = 0.5 * pattern.edge_modules, middle = 0.5 * pattern.modules;
  return {{half, 0, middle, 0, half, middle, 0, 0, 1}};
}

Mat3 UnitFromModules(const MarkerPattern& pattern) {
  const double half = 0.5 * pattern.edge_modules, middle = 0.5 * pattern.modules;
  return {{1 / half, 0, -middle / half, 0, 1 / half, -middle / half, 0, 0, 1}};
}

}  // namespace

BlockFit::BlockFit() : sums_(std::make_unique<Sums>()) {}
BlockFit::~BlockFit() = default;
BlockFit::BlockFit(BlockFit&&) noexcept = default;
BlockFit& BlockFit::operator=(BlockFit&&) noexcept = default;

int BlockFit::BlocksAlong(double marker_side_px, double block_px) {
  return std::clamp(static_cast<int>(marker_side_px / block_px), 1, kMaxBlocksAlong);
}

void BlockFit::Predict(const MarkerPattern& pattern, MarkerPart part, const ObservedPatch& observed,
                       const BlockFitState& state) {
  const double blur = state.blur_px / observed.rays.window.Scale();
  blur_px_ = state.blur_px;
  raster_.RenderMarkerOnly(pattern, state.modules_from_undistorted, observed.rays, blur, &map_,
                           &image_, &sums_->ranges);
  KnownPart known{};
  known.modules = static_cast<float>(pattern.modules);
  known.reach_px = static_cast<float>(0.5 + 1.3 * blur);
  known.max_reach_modules = kMaxReach_modules;
  const bool all = part == MarkerPart::kWhole || pattern.unknown_modules == 0;
  known.unknown_half = all ? -known.modules : 0.5F * static_cast<float>(pattern.unknown_modules);
  known.unknown_middle = static_cast<float>(pattern.unknown_first) +
                         0.5F * static_cast<float>(pattern.unknown_modules);
  sums_->blocks.Lay(pattern, known, observed, map_, sums_->ranges, grid_.tile_px,
                    grid_.blocks_along, sums_->slope);
}

void BlockFit::FitLevels(const ObservedPatch& observed, double robust_share, bool known_light) {
  sums_->blocks.Levels(observed, image_, sums_->lights, &sums_->levels);
  robustness_.noise_shares.clear();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const LevelSums& sum = sums_->levels[k];
    MarkerBlock& block = blocks_[k];
    BlockLight& light = sums_->lights[k];
    block = MarkerBlock{};
    light = BlockLight{};
    block.pixels = static_cast<int>(std::lround(sum.pixels));
    if (block.pixels < kMinBlockPixels || !(sum.w > 0.0)) continue;
    const double p = sum.wp / sum.w, i = sum.wi / sum.w;
    const double vp = sum.wpp / sum.w - p * p, vi = sum.wii / sum.w - i * i;
    const double vpi = sum.wpi / sum.w - p * i;
    block.contrast = std::sqrt(std::max(0.0, vp));
    if (block.contrast < min_contrast_ || !(vi > 1e-12)) continue;
    block.correlation = vpi / std::sqrt(vp * vi);
    if (known_light) {
      block.gain = block.weight = 1.0;
      block.noise = std::sqrt(std::max(0.0, vi - vpi * vpi / vp));
      light = {1.0F, 0.0F, static_cast<float>(1.0 / robust_share), 1.0F};
      continue;
    }
    if (!(sum.r > 0.0)) continue;
    const double rp = sum.rp / sum.r;
    const double rvp = sum.rpp / sum.r - rp * rp, rvpi = sum.rpi / sum.r - rp * (sum.ri / sum.r);
    if (!(rvp > 1e-4)) continue;
    block.gain = rvpi / rvp;
    block.offset = (sum.ri - block.gain * sum.rp) / sum.r;
    block.noise = std::sqrt(std::max(0.0, vi - vpi * vpi / vp));
    if (!(block.gain > 0.0)) continue;
    block.weight = std::clamp(
        (block.correlation - kDoubtfulCorrelation) / (kCredibleCorrelation - kDoubtfulCorrelation),
        kMinWeight, 1.0);
    robustness_.noise_shares.push_back(block.noise / block.gain);
    light = {static_cast<float>(block.gain), static_cast<float>(block.offset), 0.0F,
             static_cast<float>(block.weight)};
  }
  robustness_.share = robust_share;
  if (known_light) return;
  // Noise is not an outlier; an occluder is, and increases the apparent noise of some blocks.
  double share = robust_share;
  robustness_.noise_share = 0.0;
  if (!robustness_.noise_shares.empty()) {
    const auto quartile = robustness_.noise_shares.begin() +
                          static_cast<std::ptrdiff_t>(robustness_.noise_shares.size() / 4);
    std::nth_element(robustness_.noise_shares.begin(), quartile, robustness_.noise_shares.end());
    robustness_.noise_share = *quartile;
    share = std::max(share, kRobustNoises * robustness_.noise_share);
  }
  robustness_.share = share;
  for (BlockLight& light : sums_->lights) {
    if (light.gain > 0.0F) light.inverse = static_cast<float>(1.0 / (light.gain * share));
  }
}

void BlockFit::AddUp(const ObservedPatch& observed, const BlockFitOptions& options) {
  sums_->blocks.Motions(observed, image_, sums_->lights, options.fit_blur, &weight_,
                        &sums_->products, &sums_->motions);
  equations_ = MotionEquations(sums_->products);
  for (std::size_t k = 0; !options.known_light && k < blocks_.size(); ++k) {
    if (blocks_[k].weight > 0.0) equations_.EliminateLight(sums_->motions[k], blocks_[k].gain);
  }
  equations_.Mirror();
}

void BlockFit::EliminateSlope() {
  SlopeEquations& slopes = sums_->slopes;
  slopes.known = Correlation() > kPlainCorrelation;
  if (!slopes.known) return;
  slopes = sums_->blocks.Slopes(sums_->lights, sums_->motions);
  const Eigen::Map<const Eigen::Matrix2d> own(slopes.own[0].data());
  const Eigen::Map<const Eigen::Vector2d> right(slopes.right.data());
  const Eigen::Map<const Eigen::Matrix<double, kParameters, 2>> with(slopes.with[0].data());
  Eigen::Map<Eigen::Matrix<double, kParameters, kParameters>> hessian(equations_.hessian.data());
  Eigen::Map<Eigen::Matrix<double, kParameters, 1>> gradient(equations_.gradient.data());
  const Eigen::Matrix2d inverse = own.inverse();
  slopes.known = own.determinant() > kMinSlopeDeterminant * own(0, 0) * own(1, 1) &&
                 own(0, 0) > 0.0 && inverse.allFinite();
  if (!slopes.known) return;
  hessian.noalias() -= with * inverse * with.transpose();
  gradient.noalias() -= with * (inverse * right);
}

void BlockFit::MoveSlope(const std::array<double, kParameters>& move) {
  const SlopeEquations& slopes = sums_->slopes;
  if (!slopes.known) return;
  const Eigen::Map<const Eigen::Matrix2d> own(slopes.own[0].data());
  const Eigen::Map<const Eigen::Vector2d> right(slopes.right.data());
  const Eigen::Map<const Eigen::Matrix<double, kParameters, 2>> with(slopes.with[0].data());
  const Eigen::Vector2d change =
      own.inverse() *
      (right -
       with.transpose() * Eigen::Map<const Eigen::Matrix<double, kParameters, 1>>(move.data()));
  sums_->slope.by_u = std::clamp(sums_->slope.by_u + change[0], -kMaxSlope, kMaxSlope);
  sums_->slope.by_v = std::clamp(sums_->slope.by_v + change[1], -kMaxSlope, kMaxSlope);
}

void BlockFit::Start(const MarkerPattern& pattern, const ObservedPatch& observed, int blocks_along,
                     const BlockFitState& state) {
  grid_.blocks_along = std::clamp(blocks_along, 1, kMaxBlocksAlong);
  grid_.modules = pattern.modules;
  grid_.edge_modules = pattern.edge_modules;
  const std::size_t blocks = static_cast<std::size_t>(grid_.blocks_along) * grid_.blocks_along;
  blocks_.resize(blocks);
  sums_->lights.assign(blocks, BlockLight{});
  block_of_.resize(observed.value.size());
  weight_ = observed.inverse_variance;
  sums_->slope = {};
  int clipped = 0;
  for (std::size_t n = 0; n < weight_.size(); ++n) {
    clipped +=
        static_cast<int>(weight_[n] == 0.0F) & static_cast<int>(observed.value[n] > kClippedLight);
  }
  min_contrast_ = static_cast<double>(clipped) > kMuchClipped * static_cast<double>(weight_.size())
                      ? kMinClippedContrast
                      : kMinBlockContrast;
  const SquareSides sides =
      SidesOf(Adjugate(UnitFromModules(pattern) * state.modules_from_undistorted));
  const double shortest = sides.shortest / observed.rays.window.Scale();
  const double block_px = shortest * pattern.modules / pattern.edge_modules / grid_.blocks_along;
  grid_.tile_px = shortest >= kMinMarkerOfTiles_px && block_px >= kMinBlockOfTiles_px ? 4 : 2;
}

void BlockFit::Evaluate(const MarkerPattern& pattern, MarkerPart part,
                        const ObservedPatch& observed, int blocks_along,
                        const BlockFitState& state) {
  Start(pattern, observed, blocks_along, state);
  Predict(pattern, part, observed, state);
  FitLevels(observed, BlockFitOptions{}.robust_share, false);
  sums_->blocks.WriteBlocks(observed, &block_of_);
}

bool BlockFit::Move(const MarkerPattern& pattern, const BlockFitOptions& options, double scale,
                    BlockFitState* state, bool* done, bool* still) {
  const Mat3 unit_from_undistorted = UnitFromModules(pattern) * state->modules_from_undistorted;
  const std::optional<MotionStep> step = SolveMotion(
      equations_,
      {.damping = kDamping, .fit_projection = options.fit_projection, .fit_blur = options.fit_blur},
      SidesOf(Adjugate(unit_from_undistorted)).mean / scale);
  if (!step) return false;
  state->modules_from_undistorted =
      ModulesFromUnit(pattern) * (step->BeforeFromAfter() * unit_from_undistorted);
  if (options.fit_light) MoveSlope(step->move);
  *done = step->moved_px < options.done_px;
  *still = *done;
  if (options.fit_blur) {
    const double blur = state->blur_px / scale, fitted = step->Blur(blur);
    *still = *done && std::fabs(fitted - blur) < kStillBlur_px;
    state->blur_px = fitted * scale;
  }
  return true;
}

bool BlockFit::Run(const MarkerPattern& pattern, MarkerPart part, const ObservedPatch& observed,
                   int blocks_along, const BlockFitOptions& options, BlockFitState* state) {
  const double scale = observed.rays.window.Scale();
  bool solved = true, last = false;
  Start(pattern, observed, blocks_along, *state);
  const double module_px =
      SidesOf(Adjugate(UnitFromModules(pattern) * state->modules_from_undistorted)).shortest /
      (scale * pattern.edge_modules);
  for (int step = 0;; ++step) {
    Predict(pattern, part, observed, *state);
    if (step == 0) FitLevels(observed, options.robust_share, options.known_light);
    // The light of the step before (or none at first) determines the robust weights, and these the
    // light.
    if (options.fit_light && SurroundingsShow(module_px, blur_px_ / scale)) {
      AddSurroundings(pattern, observed, map_, sums_->ranges, blur_px_ / scale, sums_->lights,
                      grid_.blocks_along, &image_);
    }
    FitLevels(observed, options.robust_share, options.known_light);
    AddUp(observed, options);
    if (options.fit_light) EliminateSlope();
    if (step >= options.steps) break;
    bool done = false, still = false;
    solved = Move(pattern, options, scale, state, &done, &still);
    // After a small move the prediction is still valid. If only the blur has changed, one more
    // round predicts, weights and removes the remaining error with the right blur.
    if (!solved || still || last) break;
    last = done;
  }
  if (options.label_blocks) sums_->blocks.WriteBlocks(observed, &block_of_);
  return solved;
}

void BlockFit::UsePredictedVariance(ObservedPatch* observed) {
  sums_->blocks.WriteBlocks(*observed, &block_of_);
  for (std::size_t n = 0; n < observed->inverse_variance.size(); ++n) {
    if (block_of_[n] < 0 || !(observed->inverse_variance[n] > 0.0F)) continue;
    const BlockLight& light = sums_->lights[block_of_[n]];
    if (!(light.gain > 0.0F)) continue;
    const float expected = light.offset + light.gain * image_.white[n];
    // Pixels beyond a shadow edge are not as certain as those in the shadow.
    if (observed->value[n] > expected + kFarBrighter * light.gain) continue;
    observed->inverse_variance[n] = InverseVarianceOfLight(expected);
  }
}

double BlockFit::Correlation() const {
  double sum = 0.0, share = 0.0;
  for (const MarkerBlock& block : blocks_) {
    if (block.contrast < min_contrast_) continue;
    const double weight = block.pixels * block.contrast;
    sum += weight * block.correlation;
    share += weight;
  }
  return share > 0.0 ? sum / share : 0.0;
}

}  // namespace pleinair::tracker
