#include "tracker/surf_golay/cells/cell_light.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::tracker {
namespace {

constexpr float kWhiteShare = 0.75F, kBlackShare = 0.2F;
/// Ratio of black to white on ordinary prints: accurate enough to subtract black from a white
/// pixel.
constexpr float kOrdinaryBlack = 0.06F;
/// Change of the plane of log-light below which the fit has converged: a fifth of a per cent.
constexpr double kStillLogLight = 0.002;
constexpr double kBrightestQuantile = 0.9, kNarrowScale = 0.06;
constexpr float kDarkest = 2e-4F;  ///< Linear light: below the first step of an 8-bit value.
constexpr std::size_t kMinSamples = 12, kMaxSamples = 600;
constexpr double kDoubtfulBlock = 0.55, kRightBlock = 0.9;  ///< Correlations.
constexpr float kDoubtfulWeight = 0.2F;
constexpr double kMinNoise = 0.006;
/// Share of clipped white above which the block gains determine the brightness of white.
constexpr double kClippedShare = 0.5;
/// Residual spread of log white above which an edge is searched for: noise and texture alone may
/// cause less. An edge must reduce the spread to the second share.
constexpr double kEdgeSpread = 0.12, kEdgeGain = 0.6;
constexpr int kEdgeDirections = 24, kEdgeOffsets = 33;
constexpr double kEdgeReach = 1.05;

double QuantileOf(double quantile, std::vector<float>* values) {
  const auto at = static_cast<std::ptrdiff_t>(quantile * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), values->begin() + at, values->end());
  return (*values)[static_cast<std::size_t>(at)];
}

double MedianOf(std::vector<float>* values) { return QuantileOf(0.5, values); }

}  // namespace

double MarkerLight::LogWhite(double u, double v) const {
  const double log = log_white + slope_u * u + slope_v * v;
  return edge && edge->IsBeyond(u, v) ? log + edge->log_step : log;
}

double MarkerLight::White(double u, double v) const { return std::exp(LogWhite(u, v)); }

double MarkerLightEstimator::Spread(const MarkerLight& light) {
  residuals_.clear();
  for (const Sample& s : white_) {
    residuals_.push_back(static_cast<float>(std::fabs(s.log_value - light.LogWhite(s.u, s.v))));
  }
  return 1.4826 * MedianOf(&residuals_);
}

void MarkerLightEstimator::FitPlane(bool brightest, MarkerLight* light) {
  residuals_.clear();
  for (const Sample& s : white_) residuals_.push_back(s.log_value);
  light->log_white = QuantileOf(brightest ? kBrightestQuantile : 0.5, &residuals_);
  double scale = brightest ? kNarrowScale : 1.0;
  for (int round = 0; round < 6; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Sample& s : white_) {
      const double side =
          light->edge && light->edge->IsBeyond(s.u, s.v) ? light->edge->log_step : 0.0;
      const double value = s.log_value - side;
      const double left = value - light->log_white - light->slope_u * s.u - light->slope_v * s.v;
      const double w = s.weight / (1.0 + left * left / (scale * scale));
      const Eigen::Vector3d row(1.0, s.u, s.v);
      normal += w * row * row.transpose();
      right += w * value * row;
    }
    // A weak prior for uniform light keeps the plane flat if only one side of the marker is
    // observed.
    const double prior = 0.02 * normal(0, 0);
    normal(1, 1) += prior;
    normal(2, 2) += prior;
    const Eigen::Vector3d plane = normal.ldlt().solve(right);
    if (!plane.allFinite()) return;
    const bool still = std::fabs(plane[0] - light->log_white) < kStillLogLight &&
                       std::fabs(plane[1] - light->slope_u) < kStillLogLight &&
                       std::fabs(plane[2] - light->slope_v) < kStillLogLight;
    light->log_white = plane[0];
    light->slope_u = plane[1];
    light->slope_v = plane[2];
    if (still) return;
    scale = brightest ? kNarrowScale : std::max(0.05, 2.0 * Spread(*light));
  }
}

std::optional<ShadowEdge> MarkerLightEstimator::FitEdge() const {
  // Two levels on either side of a line: the split with the minimum sum of squares. With prefix
  // sums over offsets a direction needs one pass.
  struct Bin {
    double w = 0, s = 0, ss = 0;
  };
  ShadowEdge edge;
  double best = 0.0, total_w = 0.0, total_s = 0.0, total_ss = 0.0;
  for (const Sample& s : white_) {
    total_w += s.weight;
    total_s += s.weight * s.log_value;
    total_ss += s.weight * s.log_value * s.log_value;
  }
  const double without = total_ss - total_s * total_s / total_w;
  best = without;
  for (int direction = 0; direction < kEdgeDirections; ++direction) {
    const double angle = std::numbers::pi * direction / kEdgeDirections;
    const double cu = std::cos(angle), cv = std::sin(angle);
    std::array<Bin, kEdgeOffsets + 1> bins{};
    for (const Sample& s : white_) {
      const double at = (cu * s.u + cv * s.v) / (2.0 * kEdgeReach) + 0.5;
      const int bin =
          std::clamp(static_cast<int>(std::ceil(at * (kEdgeOffsets - 1))), 0, kEdgeOffsets);
      bins[bin].w += s.weight;
      bins[bin].s += s.weight * s.log_value;
      bins[bin].ss += s.weight * s.log_value * s.log_value;
    }
    double w = 0, sum = 0;
    for (int offset = 0; offset < kEdgeOffsets; ++offset) {
      w += bins[offset].w;
      sum += bins[offset].s;
      const double other_w = total_w - w, other_sum = total_s - sum;
      if (w < 0.04 * total_w || other_w < 0.04 * total_w) continue;
      const double left = total_ss - sum * sum / w - other_sum * other_sum / other_w;
      if (left < best) {
        best = left;
        edge.u = cu;
        edge.v = cv;
        edge.at = (static_cast<double>(offset) / (kEdgeOffsets - 1) - 0.5) * 2.0 * kEdgeReach;
        edge.log_step = other_sum / other_w - sum / w;
      }
    }
  }
  if (!(best < kEdgeGain * without)) return std::nullopt;
  return edge;
}

bool MarkerLightEstimator::FromBlocks(const BlockFit& fit, MarkerLight* light) {
  double weight = 0.0, white = 0.0, black = 0.0;
  for (const MarkerBlock& block : fit.blocks()) {
    const double w = block.weight * block.pixels * block.contrast;
    weight += w;
    white += w * (block.gain + block.offset);
    black += w * block.offset;
  }
  if (!(weight > 0.0) || !(white > 0.0)) return false;
  light->log_white = std::log(white / weight);
  light->black_share = std::clamp(black / white, 0.0, 0.9);
  return true;
}

bool MarkerLightEstimator::Measure(const MarkerPattern& pattern, const BlockFit& fit,
                                   const ObservedPatch& observed, bool brightest,
                                   MarkerLight* light) {
  white_.clear();
  black_.clear();
  const float middle = 0.5F * static_cast<float>(pattern.modules);
  const float per_half = 2.0F / static_cast<float>(pattern.edge_modules);
  std::size_t usable = 0;
  for (std::size_t n = 0; n < observed.value.size(); ++n) usable += fit.block_of()[n] >= 0;
  const std::size_t stride = std::max<std::size_t>(1, usable / (3 * kMaxSamples));
  std::size_t count = 0, clipped_white = 0;
  for (std::size_t n = 0; n < observed.value.size(); ++n) {
    if (fit.block_of()[n] < 0 || ++count % stride != 0) continue;
    const float share = fit.image().white[n];
    const bool clipped = !(observed.inverse_variance[n] > 0.0F);
    // A block of part paper, part occluder has light levels of its own: only blocks that match as a
    // whole count.
    const MarkerBlock& block = fit.blocks()[fit.block_of()[n]];
    const float right = std::clamp(
        static_cast<float>((block.correlation - kDoubtfulBlock) / (kRightBlock - kDoubtfulBlock)),
        0.0F, 1.0F);
    const float robust_weight =
        clipped ? static_cast<float>(block.weight) : right * fit.RobustWeightOf(n, observed);
    if (robust_weight < kDoubtfulWeight) continue;
    const float value = std::max(observed.value[n], kDarkest);
    const float u = (fit.map().column[n] - middle) * per_half;
    const float v = (fit.map().row[n] - middle) * per_half;
    if (share > kWhiteShare) {
      const float white = value / (share + kOrdinaryBlack * (1.0F - share));
      white_.push_back({u, v, std::log(white), share, robust_weight});
      clipped_white += clipped;
    }
    if (share < kBlackShare) black_.push_back({u, v, std::log(value), share, robust_weight});
  }
  *light = MarkerLight{};
  if (white_.size() < kMinSamples || black_.size() < kMinSamples / 2) {
    return FromBlocks(fit, light);
  }
  if (clipped_white > kClippedShare * white_.size()) {
    if (!FromBlocks(fit, light)) return false;
    light->white_clips = true;
    if (brightest) {
      // The few unclipped pixels at edges determine the white badly. The black determines it, as
      // far as the marker's ink is ordinary.
      const double black = light->black_share * std::exp(light->log_white);
      light->log_white = std::log(black / kOrdinaryBlack);
      light->black_share = kOrdinaryBlack;
    }
    light->log_white = std::max(light->log_white, 0.0);
    return true;
  }
  FitPlane(brightest, light);
  light->spread = Spread(*light);
  if (brightest) light->spread = std::min(light->spread, kNarrowScale);
  if (!brightest && light->spread > kEdgeSpread) {
    MarkerLight with_edge;
    with_edge.edge = FitEdge();
    if (with_edge.edge) {
      FitPlane(false, &with_edge);
      with_edge.spread = Spread(with_edge);
      if (with_edge.spread < kEdgeGain * light->spread) *light = with_edge;
    }
  }
  residuals_.clear();
  for (const Sample& s : black_) {
    residuals_.push_back(static_cast<float>(
        (std::exp(s.log_value) / light->White(s.u, s.v) - s.share) / (1.0 - s.share)));
  }
  light->black_share = std::clamp(MedianOf(&residuals_), 0.0, 0.9);
  for (float& residual : residuals_) {
    residual = std::fabs(residual - static_cast<float>(light->black_share));
  }
  light->white_noise = std::clamp(light->spread, kMinNoise, 1.0);
  light->black_noise = std::clamp(1.4826 * MedianOf(&residuals_), kMinNoise, 1.0);
  return true;
}

}  // namespace pleinair::tracker
