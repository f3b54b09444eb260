#include "tracker/refinement/marker_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pleinair::tracker {
namespace {

constexpr int kHomographyParameters = 8;
constexpr int kBlurParameter = 8;
constexpr int kFirstLevel = 9;

constexpr double kMinBlur_px = 0.05, kMaxBlur_px = 12.0;
/// The blur is never below 0.05 px. Sharp images do not determine it; a weak prior in the logarithm
/// (±1) keeps it from drifting there.
constexpr double kBlurPriorSigma = 1.0;
/// Standard deviation between the levels of neighbouring nodes, as a share of the marker's
/// contrast.
constexpr double kLevelPriorShare = 0.3;
/// Tukey's biweight: 95 % efficient for Gaussian noise (Huber & Ronchetti 2009).
constexpr double kTukey = 4.685;
constexpr int kMaxIterations = 25;
/// A large marker is first fitted to about this many of its pixels; the fit to all of them then
/// needs few steps.
constexpr std::size_t kCoarsePixels = 1200;
/// Side of the blocks that scale the covariance. Residuals of neighbouring pixels are correlated:
/// JPEG blocks, texture of the paper, shadow edges.
constexpr int kBlock_px = 8;

}  // namespace

void MarkerFit::Predict(const MarkerFitState& state, std::vector<Predicted>* predicted) const {
  predicted->clear();
  predicted->reserve(pixels_.size());
  const MarkerPrediction predict(pattern_, state);
  for (const MarkerPixel& pixel : pixels_) predicted->push_back(predict(pixel));
}

MarkerFit::NormalEquations MarkerFit::EquationsOf(const std::vector<Predicted>& predictions,
                                                  const MarkerFitState& state,
                                                  BlockGradients* blocks) const {
  NormalEquations equations;
  const int parameters = kFirstLevel + static_cast<int>(state.levels.size());
  equations.hessian = Eigen::MatrixXd::Zero(parameters, parameters);
  equations.gradient = Eigen::VectorXd::Zero(parameters);
  equations.residuals.reserve(pixels_.size());
  constexpr int kTouched = kFirstLevel + 8;
  std::array<double, kTouched> jacobian{};
  std::array<int, kTouched> index{};  // Ascending.
  for (int i = 0; i < kFirstLevel; ++i) index[i] = i;
  for (std::size_t n = 0; n < pixels_.size(); ++n) {
    const MarkerPixel& pixel = pixels_[n];
    const Predicted& predicted = predictions[n];
    const Coverage& coverage = predicted.coverage;
    const double residual = predicted.residual;
    const double by_coverage = predicted.slope * predicted.contrast;
    const double edge = std::max(0.0, 4.0 * coverage.white * (1.0 - coverage.white));
    equations.residuals.push_back({residual, std::fabs(by_coverage) * std::sqrt(edge)});
    if (predicted.clipped) continue;
    const double u = predicted.marker.x, v = predicted.marker.y;

    const double z = residual / (kTukey * std::sqrt(variance_[n]));
    const double kept = 1.0 - z * z;
    // Tukey's biweight: ρ = c²/6 (1 - (1 - z²)³), weight (1 - z²)².
    equations.cost += kTukey * kTukey / 3.0 * (std::fabs(z) < 1.0 ? 1.0 - kept * kept * kept : 1.0);
    if (std::fabs(z) >= 1.0) continue;
    const double weight = kept * kept / variance_[n];

    const double g_u = by_coverage * coverage.d_u, g_v = by_coverage * coverage.d_v;
    // The homography moves by rays_from_marker (I + Δ), so a pixel's marker coordinates change by
    // minus the flow of Δ.
    const double along = g_u * u + g_v * v;
    jacobian = {-g_u,      -g_u * u,  -g_u * v,
                -g_v,      -g_v * u,  -g_v * v,
                along * u, along * v, by_coverage * coverage.d_log_blur};
    for (int k = 0; k < 4; ++k) {
      index[kFirstLevel + 2 * k] = kFirstLevel + LevelIndex(predicted.node[k], 0);
      index[kFirstLevel + 2 * k + 1] = kFirstLevel + LevelIndex(predicted.node[k], 1);
      jacobian[kFirstLevel + 2 * k] = predicted.slope * (1.0 - coverage.white) * predicted.hat[k];
      jacobian[kFirstLevel + 2 * k + 1] = predicted.slope * coverage.white * predicted.hat[k];
    }
    if (blocks != nullptr) {
      Eigen::VectorXd& sum = blocks
                                 ->try_emplace({pixel.x / kBlock_px, pixel.y / kBlock_px},
                                               Eigen::VectorXd::Zero(parameters))
                                 .first->second;
      for (int i = 0; i < kTouched; ++i) sum[index[i]] += weight * residual * jacobian[i];
    }
    for (int i = coverage.uniform ? kFirstLevel : 0; i < kTouched; ++i) {
      const double weighted = weight * jacobian[i];
      equations.gradient[index[i]] += weighted * residual;
      for (int j = i; j < kTouched; ++j) {
        equations.hessian(index[j], index[i]) += weighted * jacobian[j];
      }
    }
  }
  AddPriors(state, &equations);
  equations.hessian.triangularView<Eigen::StrictlyUpper>() = equations.hessian.transpose();
  return equations;
}

void MarkerFit::AddPriors(const MarkerFitState& state, NormalEquations* equations) const {
  const double blur_weight = 1.0 / (kBlurPriorSigma * kBlurPriorSigma);
  const double blur_error = state.log_blur - std::log(kInitialBlur_px);
  equations->hessian(kBlurParameter, kBlurParameter) += blur_weight;
  equations->gradient[kBlurParameter] += blur_weight * blur_error;
  equations->cost += blur_weight * blur_error * blur_error;
  const double level_weight = 1.0 / std::pow(kLevelPriorShare * contrast_, 2);
  const auto tie = [&](int node, int neighbour) {
    for (int white = 0; white < 2; ++white) {
      const int p = LevelIndex(node, white), q = LevelIndex(neighbour, white);
      const double difference = state.levels[p] - state.levels[q];
      equations->cost += level_weight * difference * difference;
      equations->gradient[kFirstLevel + p] += level_weight * difference;
      equations->gradient[kFirstLevel + q] -= level_weight * difference;
      equations->hessian(kFirstLevel + p, kFirstLevel + p) += level_weight;
      equations->hessian(kFirstLevel + q, kFirstLevel + q) += level_weight;
      equations->hessian(kFirstLevel + q, kFirstLevel + p) -= level_weight;
    }
  };
  for (int j = 0; j < state.nodes; ++j) {
    for (int i = 0; i < state.nodes; ++i) {
      if (i + 1 < state.nodes) tie(j * state.nodes + i, j * state.nodes + i + 1);
      if (j + 1 < state.nodes) tie(j * state.nodes + i, (j + 1) * state.nodes + i);
    }
  }
}

MarkerFitState MarkerFit::Moved(const MarkerFitState& state, const Eigen::VectorXd& step) {
  MarkerFitState moved = state;
  const Mat3 motion{
      {1.0 + step[1], step[2], step[0], step[4], 1.0 + step[5], step[3], step[6], step[7], 1.0}};
  moved.rays_from_marker = state.rays_from_marker * motion;
  moved.log_blur = std::clamp(state.log_blur + step[kBlurParameter], std::log(kMinBlur_px),
                              std::log(kMaxBlur_px));
  moved.levels += step.tail(step.size() - kFirstLevel);
  return moved;
}

void MarkerFit::SetNoise(const MarkerNoise& noise, const NormalEquations& equations) {
  noise_ = noise;
  variance_.resize(pixels_.size());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    variance_[i] = noise.Variance(equations.residuals[i].edge_gain);
  }
}

bool MarkerFit::Run(const MarkerFitState& start) {
  state_ = start;
  if (all_pixels_.size() > 2 * kCoarsePixels) {
    std::vector<MarkerPixel> coarse;
    const std::size_t step = all_pixels_.size() / kCoarsePixels;
    for (std::size_t i = 0; i < all_pixels_.size(); i += step) coarse.push_back(all_pixels_[i]);
    if (!Optimize(std::move(coarse))) return false;
  }
  if (!Optimize(all_pixels_)) return false;
  fitted_ = EquationsOf(predicted_, state_, &blocks_);
  return true;
}

bool MarkerFit::Optimize(std::vector<MarkerPixel> pixels) {
  pixels_ = std::move(pixels);
  variance_.assign(pixels_.size(), 1.0);
  double damping = 1e-3;
  // The noise decreases as the fit improves; it is constant while steps are compared.
  Predict(state_, &predicted_);
  NormalEquations equations = EquationsOf(predicted_, state_, nullptr);
  MarkerNoise noise = EstimateMarkerNoise(equations.residuals);
  SetNoise({std::max(4.0, 1.5 * noise.flat_codes), 1.5 * noise.edge_share}, equations);
  equations = EquationsOf(predicted_, state_, nullptr);
  int since_noise = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Eigen::MatrixXd damped = equations.hessian;
    damped.diagonal() += damping * equations.hessian.diagonal();
    damped.diagonal().array() += 1e-9;
    const Eigen::VectorXd step = damped.ldlt().solve(-equations.gradient);
    if (!step.allFinite()) return false;
    const MarkerFitState candidate = Moved(state_, step);
    Predict(candidate, &next_predicted_);
    NormalEquations next = EquationsOf(next_predicted_, candidate, nullptr);
    const bool better = next.cost < equations.cost;
    const double moved_px = step.head(kHomographyParameters).cwiseAbs().maxCoeff() * side_px_ / 2.0;
    if (better) {
      state_ = candidate;
      std::swap(predicted_, next_predicted_);
      equations = std::move(next);
      damping = std::max(1e-7, damping * 0.2);
      ++since_noise;
    } else {
      damping *= 8.0;
      if (damping > 1e4) break;
    }
    if (since_noise >= 2 || moved_px < 1e-3) {
      since_noise = 0;
      noise = EstimateMarkerNoise(equations.residuals);
      const double before = std::hypot(noise_.flat_codes, 255.0 * noise_.edge_share);
      noise.flat_codes = std::clamp(noise.flat_codes, 0.6 * noise_.flat_codes, noise_.flat_codes);
      noise.edge_share = std::clamp(noise.edge_share, 0.6 * noise_.edge_share, noise_.edge_share);
      const double now = std::hypot(noise.flat_codes, 255.0 * noise.edge_share);
      if (now > 0.98 * before && moved_px < 1e-3) break;
      SetNoise(noise, equations);
      equations = EquationsOf(predicted_, state_, nullptr);
    }
  }
  return true;
}

double MarkerFit::ResidualCodes() const { return RobustScale(fitted_.residuals); }

double MarkerFit::AgreeingShare() const {
  const std::vector<MarkerResidual>& residuals = fitted_.residuals;
  std::size_t agreeing = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    agreeing += std::fabs(residuals[i].codes) < std::max(12.0, kTukey * std::sqrt(variance_[i]));
  }
  return static_cast<double>(agreeing) / static_cast<double>(residuals.size());
}

double MarkerFit::CorrelationFactor(const BlockGradients& blocks,
                                    const Eigen::MatrixXd& covariance) {
  // Clustered sandwich estimate of a covariance (Liang & Zeger 1986): H⁻¹ (Σ_blocks g gᵀ) H⁻¹ in
  // place of H⁻¹. With few blocks the matrix is inaccurate; its mean ratio to H⁻¹ is usable.
  Eigen::MatrixXd sandwich = Eigen::MatrixXd::Zero(kHomographyParameters, kHomographyParameters);
  for (const auto& [place, gradient] : blocks) {
    const Eigen::VectorXd moved = (covariance * gradient).head<kHomographyParameters>();
    sandwich += moved * moved.transpose();
  }
  const Eigen::MatrixXd plain =
      covariance.topLeftCorner(kHomographyParameters, kHomographyParameters);
  return std::max(1.0, plain.ldlt().solve(sandwich).trace() / kHomographyParameters);
}

std::array<double, 64> MarkerFit::MotionCovariance() const {
  const Eigen::Index parameters = fitted_.gradient.size();
  const Eigen::MatrixXd covariance =
      fitted_.hessian.ldlt().solve(Eigen::MatrixXd::Identity(parameters, parameters));
  std::array<double, 64> motion{};
  Eigen::Map<Eigen::Matrix<double, 8, 8, Eigen::RowMajor>>(motion.data()) =
      covariance.topLeftCorner<8, 8>() * CorrelationFactor(blocks_, covariance);
  return motion;
}

}  // namespace pleinair::tracker
