#include "compositor/photometry/changes/probe_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "base/quantile.h"
#include "compositor/photometry/student_distribution.h"

namespace pleinair::compositor {
namespace {

// Degrees of freedom of the residuals' distribution, for people and cars among the probes.
constexpr double kFreedom = 4.0;
// Standard deviation of a single probe's modelled sun over sky beside that of its plane,
// logarithmic, and its largest value.
constexpr double kShareSpread = 0.1, kLargestShareError = 0.5;
// Smallest relative noise of a probe: errors of the model and of compression.
constexpr double kMinNoise = 0.01;
// Readings that count as much for a probe's noise as the usual noise does.
constexpr double kUsualNoiseReadings = 5.0;
// Logarithm of the odds against unmodelled shade before anything is seen.
constexpr double kShadeOdds = 3.0;
// Rounds in which albedo and error are found for shade and for none, and readings that suffice.
constexpr int kShadeRounds = 4;
constexpr std::size_t kShadeReadings = 60;
constexpr double kDarkest = 1e-6;

/// Light of sun and sky on a probe in one frame, red, green and blue.
struct Lit {
  std::array<double, 3> sun, sky;
};

Lit LitBy(const std::array<LinearRgb, 2>& parts, const LogLight& factors) {
  const auto& [sun, sky] = parts;
  return {{sun.r * factors[0], sun.g * factors[1], sun.b * factors[2]},
          {sky.r * factors[3], sky.g * factors[4], sky.b * factors[5]}};
}

}  // namespace

void ProbeFit::Add(std::size_t frame, const std::array<float, 3>& linear) {
  ProbeReading reading;
  reading.frame = static_cast<std::uint32_t>(frame);
  for (int c = 0; c < 3; ++c) {
    reading.log_linear[c] = static_cast<float>(std::log(std::max<double>(linear[c], kDarkest)));
  }
  readings_.push_back(reading);
}

std::array<LinearRgb, 2> ProbeFit::Parts(const PlaneError& plane_error) const {
  const LinearRgb of_sun =
      light_.direct * (shaded_ ? 0.0 : light_.sun_visibility) + light_.reflected;
  const LinearRgb error{std::exp(plane_error[0] + unknowns_[3]),
                        std::exp(plane_error[1] + unknowns_[3]),
                        std::exp(plane_error[2] + unknowns_[3])};
  return {of_sun * error, light_.sky + LinearRgb{1, 1, 1} * kDarkest};
}

double ProbeFit::SunShare() const {
  const Lit lit = LitBy(Parts(PlaneError::Zero()), LogLight::Ones());
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) sum += lit.sun[c] / (lit.sun[c] + lit.sky[c]);
  return sum / 3;
}

double ProbeFit::Brightness(const ProbeReading& reading) const {
  const Lit lit = LitBy(Parts(PlaneError::Zero()), LogLight::Ones());
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) {
    sum += reading.log_linear[c] - unknowns_[c] - std::log(lit.sun[c] + lit.sky[c]);
  }
  return sum / 3;
}

void ProbeFit::SetAlbedo(const std::vector<LogLight>& factors) {
  const auto parts = Parts(PlaneError::Zero());
  std::array<std::vector<double>, 3> values;
  for (const ProbeReading& reading : readings_) {
    const Lit lit = LitBy(parts, factors[reading.frame]);
    for (int c = 0; c < 3; ++c) {
      values[c].push_back(reading.log_linear[c] - std::log(lit.sun[c] + lit.sky[c]));
    }
  }
  for (int c = 0; c < 3 && !values[c].empty(); ++c) unknowns_[c] = Median(values[c]);
}

void ProbeFit::Linearize(const std::vector<LogLight>& factors, const PlaneError& plane_error,
                         const std::vector<double>& independent) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  right_.setZero();
  double mean = 0.0;
  const auto parts = Parts(plane_error);
  terms_.resize(readings_.size());
  for (std::size_t k = 0; k < readings_.size(); ++k) {
    ProbeReading& reading = readings_[k];
    ReadingTerm& term = terms_[k];
    term.frame = reading.frame;
    const Lit lit = LitBy(parts, factors[reading.frame]);
    const double counts = independent[reading.frame] / (noise_ * noise_);
    mean += independent[reading.frame] / static_cast<double>(readings_.size());
    for (int c = 0; c < 3; ++c) {
      const double total = lit.sun[c] + lit.sky[c], share = lit.sun[c] / total;
      const double residual = reading.log_linear[c] - unknowns_[c] - std::log(total);
      const double weight = counts * StudentWeight(residual, noise_, kFreedom);
      term.sun_share[c] = static_cast<float>(share);
      reading.residual[c] = static_cast<float>(residual);
      term.weight[c] = static_cast<float>(weight);
      matrix(c, c) += weight;
      matrix(c, 3) += weight * share;
      matrix(3, 3) += weight * share * share;
      right_[c] += weight * residual;
      right_[3] += weight * share * residual;
    }
  }
  matrix.row(3).head<3>() = matrix.col(3).head<3>().transpose();
  // Readings that are alike in all probes count less; so does what is known of each of them.
  prior_ = mean / (kShareSpread * kShareSpread);
  matrix(3, 3) += prior_;
  right_[3] -= prior_ * unknowns_[3];
  matrix.diagonal().array() += kDarkest;
  inverse_ = matrix.ldlt().solve(Eigen::Matrix4d::Identity());
}

void ProbeFit::AddEquations(std::vector<LogLight>* right, PlaneError* plane_right,
                            std::vector<LogLightMatrix>* diagonal,
                            PlaneError* plane_diagonal) const {
  const Unknowns own = inverse_ * right_;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const ReadingTerm& term = terms_[k];
    LogLight& frame_right = (*right)[term.frame];
    LogLightMatrix& frame = (*diagonal)[term.frame];
    for (int c = 0; c < 3; ++c) {
      const double share = term.sun_share[c], weight = term.weight[c], rest = 1.0 - share;
      const double pull = weight * (readings_[k].residual[c] - own[c] - share * own[3]);
      frame_right[c] += share * pull;
      frame_right[3 + c] += rest * pull;
      (*plane_right)[c] += share * pull;
      frame(c, c) += weight * share * share;
      frame(3 + c, 3 + c) += weight * rest * rest;
      frame(c, 3 + c) += weight * share * rest;
      frame(3 + c, c) += weight * share * rest;
      (*plane_diagonal)[c] += weight * share * share;
    }
  }
}

ProbeFit::Unknowns ProbeFit::Gather(const std::vector<LogLight>& step,
                                    const PlaneError& plane_step) const {
  Unknowns sum = Unknowns::Zero();
  for (const ReadingTerm& term : terms_) {
    const LogLight& move = step[term.frame];
    for (int c = 0; c < 3; ++c) {
      const double share = term.sun_share[c];
      const double change =
          term.weight[c] * (share * (move[c] + plane_step[c]) + (1.0 - share) * move[3 + c]);
      sum[c] += change;
      sum[3] += share * change;
    }
  }
  return sum;
}

void ProbeFit::AddProduct(const std::vector<LogLight>& step, const PlaneError& plane_step,
                          std::vector<LogLight>* product, PlaneError* plane_product) const {
  const Unknowns own = inverse_ * Gather(step, plane_step);
  for (const ReadingTerm& term : terms_) {
    const LogLight& move = step[term.frame];
    LogLight& out = (*product)[term.frame];
    for (int c = 0; c < 3; ++c) {
      const double share = term.sun_share[c], rest = 1.0 - share;
      const double pull = term.weight[c] * (share * (move[c] + plane_step[c]) + rest * move[3 + c] -
                                            own[c] - share * own[3]);
      out[c] += share * pull;
      out[3 + c] += rest * pull;
      (*plane_product)[c] += share * pull;
    }
  }
}

void ProbeFit::PutNoise(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  right_.setZero();
  right_[3] = std::sqrt(prior_) * normal(random);
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const ReadingTerm& term = terms_[k];
    for (int c = 0; c < 3; ++c) {
      const double weight = std::max<double>(term.weight[c], kDarkest);
      const double residual = normal(random) / std::sqrt(weight);
      readings_[k].residual[c] = static_cast<float>(residual);
      right_[c] += weight * residual;
      right_[3] += weight * term.sun_share[c] * residual;
    }
  }
}

void ProbeFit::Move(const std::vector<LogLight>& step, const PlaneError& plane_step) {
  unknowns_ += inverse_ * (right_ - Gather(step, plane_step));
  unknowns_[3] = std::clamp(unknowns_[3], -kLargestShareError, kLargestShareError);
}

void ProbeFit::SetNoise(double usual) {
  double sum = 0.0;
  for (const ProbeReading& reading : readings_) {
    for (const double residual : reading.residual) {
      sum += StudentWeight(residual, noise_, kFreedom) * residual * residual / 3;
    }
  }
  const double square = (sum + kUsualNoiseReadings * usual * usual) /
                        (static_cast<double>(readings_.size()) + kUsualNoiseReadings);
  noise_ = std::max(kMinNoise, std::sqrt(square));
}

double ProbeFit::Cost(const std::vector<LogLight>& factors, const PlaneError& plane_error,
                      const std::vector<double>& independent, std::vector<double>* by_frame) const {
  double cost = 0.5 * unknowns_[3] * unknowns_[3] / (kShareSpread * kShareSpread);
  const auto parts = Parts(plane_error);
  for (const ProbeReading& reading : readings_) {
    const Lit lit = LitBy(parts, factors[reading.frame]);
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double light = std::log(lit.sun[c] + lit.sky[c]);
      sum += StudentCost(reading.log_linear[c] - unknowns_[c] - light, noise_, kFreedom);
    }
    // Channels err alike: together they count as one reading.
    sum *= independent[reading.frame] / 3;
    cost += sum;
    (*by_frame)[reading.frame] += sum;
  }
  return cost;
}

void ProbeFit::DecideShade(const std::vector<LogLight>& factors, const PlaneError& plane_error) {
  if (light_.direct.g * light_.sun_visibility <= 0.0 || readings_.empty()) return;
  const std::vector<double> independent(factors.size(), 1.0);
  const std::vector<LogLight> still(factors.size(), LogLight::Zero());
  ProbeFit some = *this;
  const std::size_t count = std::min(readings_.size(), kShadeReadings);
  for (std::size_t k = 0; k < count; ++k) {
    some.readings_[k] = readings_[(2 * k + 1) * readings_.size() / (2 * count)];
  }
  some.readings_.resize(count);
  const auto fitted = [&](bool shaded) {
    ProbeFit probe = some;
    if (shaded != shaded_) {
      probe.shaded_ = shaded;
      probe.unknowns_[3] = 0.0;
      probe.SetAlbedo(factors);
    }
    for (int i = 0; i < kShadeRounds; ++i) {
      probe.Linearize(factors, plane_error, independent);
      probe.Move(still, PlaneError::Zero());
    }
    return probe;
  };
  const ProbeFit sunlit = fitted(false), shaded = fitted(true);
  const auto cost = [&](const ProbeFit& probe) {
    std::vector<double> by_frame(factors.size(), 0.0);
    return probe.Cost(factors, plane_error, independent, &by_frame);
  };
  const bool better = cost(shaded) + kShadeOdds < cost(sunlit);
  shaded_ = better;
  unknowns_ = better ? shaded.unknowns_ : sunlit.unknowns_;
}

}  // namespace pleinair::compositor
