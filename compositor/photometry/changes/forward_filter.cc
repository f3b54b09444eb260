#include "compositor/photometry/changes/forward_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantile.h"
#include "compositor/photometry/changes/light_source.h"
#include "compositor/photometry/changes/light_start.h"
#include "compositor/photometry/student_distribution.h"

namespace pleinair::compositor {
namespace {

// Max. rounds of one frame, and factors on the noise in the first rounds. With them, every probe
// counts at first. Otherwise a shadow that stays as it was would pass for an outlier.
constexpr int kMaxRounds = 12;
constexpr std::array kNoiseScales{4.0, 2.0};
// Change of brightness from which a frame's fit has more than one start, and the least sun of one.
constexpr double kMinStartChange = 0.03, kFaintest = 0.05;
// Logarithmic step at which the rounds end, and the largest step of one.
constexpr double kConverged = 5e-4, kLargestStep = 0.5;
// Degrees of freedom of the residuals' distribution, for people and cars among the probes.
constexpr double kFreedom = 4.0;
// Standard deviations beyond which a reading is an outlier and says nothing of the light.
constexpr double kOutlier = 4.0;
// Smallest relative noise of a probe: errors of the model and of
// compression.
constexpr double kMinNoise = 0.01;
// Readings that count as much for a probe's noise as the usual noise does, and the largest number
// over which it is averaged.
constexpr double kUsualNoiseReadings = 5.0, kNoiseReadings = 100.0;
// Standard deviation of a single probe's modelled sun over sky, logarithmic.
constexpr double kShareSpread = 0.1;
// The same of an error that all probes have in common.
constexpr double kCommonShareSpread = 0.08;
// Logarithm of the odds against unmodelled shade before anything is seen, and the largest later.
constexpr double kShadeOdds = 3.0, kMaxShadeOdds = 15.0;
// Independent probes of a frame: errors of neighbours are alike.
constexpr double kIndependentProbes = 100.0;
// A change of sun over sky, as a part of the full sun, and the logarithm of the likelihoods' ratio
// that proves it. It is that of three frames of FitLightChanges().
constexpr double kMinChange = 0.05, kConclusive = 60.0;
constexpr double kDarkest = 1e-6;

std::array<double, 3> Array(LinearRgb color) { return {color.r, color.g, color.b}; }

double Mean(const std::array<double, 3>& values) { return (values[0] + values[1] + values[2]) / 3; }

double Square(double x) { return x * x; }

/// Variance of log(sun over sky).
double Variance(const LogLightMatrix& covariance) {
  return RatioDirection().dot(covariance * RatioDirection());
}

LogLightMatrix Inverse(const LogLightMatrix& matrix) {
  return matrix.ldlt().solve(LogLightMatrix::Identity());
}

}  // namespace

void ForwardFilter::Start(const LogLight& light, double log_ratio_error) {
  probes_.clear();
  light_ = light;
  covariance_.setZero();
  common_ = {log_ratio_error, 0.0};
  evidence_ = 0.0;
  changes_ = std::fabs(std::expm1(RatioDirection().dot(light))) > kMinChange;
}

void ForwardFilter::AddProbe(const ProbeLight& light) {
  const LinearRgb none{kDarkest, kDarkest, kDarkest};
  Probe probe;
  const LinearRgb direct = light.direct * light.sun_visibility;
  probe.cases[0].sun = Array(direct + light.reflected);
  probe.cases[1].sun = Array(light.reflected);
  for (Case& one : probe.cases) one.sky = Array(light.sky + none);
  probe.may_be_shaded = direct.g > 0.0;
  probe.log_odds_shade = -kShadeOdds;
  probes_.push_back(probe);
}

ForwardFilter::Explained ForwardFilter::Explain(const Probe& probe, const Case& as,
                                                const Reading& reading,
                                                const LogLight& factors) const {
  Explained explained;
  for (int c = 0; c < 3; ++c) {
    const double sun = as.sun[c] * factors[c], total = sun + as.sky[c] * factors[3 + c];
    explained.share[c] = sun / total;
    explained.residual[c] = reading.log_linear[c] - as.log_albedo[c] - std::log(total);
    // A wrong share matters as far as it differs from that under which the albedo was learnt.
    explained.variance[c] = probe.noise_square + as.variance[c] + Square(probe.learnt.by_chance) +
                            Square(kShareSpread * (explained.share[c] - as.share[c]));
  }
  return explained;
}

/// Negative logarithm of a reading's likelihood, less that at its mean: or else a light that
/// changes little would gain by the smaller variance alone. Channels err alike: they count as one
/// reading. An outlier has the same cost under any light.
double ForwardFilter::Cost(const Explained& explained, double noise_scale) {
  double cost = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double scale = noise_scale * std::sqrt(explained.variance[c]);
    const double residual = std::min(std::fabs(explained.residual[c]), kOutlier * scale);
    cost += StudentCost(residual, scale, kFreedom) / 3;
  }
  return cost;
}

std::array<double, 2> ForwardFilter::ProbabilitiesOf(const Probe& probe,
                                                     const std::array<double, 2>& costs) {
  if (!probe.may_be_shaded) return {1.0, 0.0};
  const double of_shade = 1.0 / (1.0 + std::exp(costs[1] - costs[0] - probe.log_odds_shade));
  return {1.0 - of_shade, of_shade};
}

ForwardFilter::Equations ForwardFilter::AddUp(const std::vector<Reading>& readings,
                                              const LogLight& light, double noise_scale) const {
  const LogLight factors = light.array().exp();
  const double independent = std::min(
      1.0, kIndependentProbes / std::max<double>(1.0, static_cast<double>(readings.size())));
  Equations sum{LogLightMatrix::Zero(), LogLight::Zero(), {}, 0.0};
  double weights = 0.0, share_squares = kDarkest;
  for (const Reading& reading : readings) {
    const Probe& probe = probes_[reading.probe];
    std::array<Explained, 2> by_case;
    std::array<double, 2> costs{};
    const std::size_t count = probe.may_be_shaded ? 2 : 1;
    for (std::size_t k = 0; k < count; ++k) {
      by_case[k] = Explain(probe, probe.cases[k], reading, factors);
      costs[k] = Cost(by_case[k], noise_scale);
    }
    const std::array<double, 2> probabilities = ProbabilitiesOf(probe, costs);
    for (std::size_t k = 0; k < count; ++k) {
      const double probability = probabilities[k];
      const Explained& explained = by_case[k];
      sum.cost += probability * independent * costs[k];
      for (int c = 0; c < 3; ++c) {
        const double variance = Square(noise_scale) * explained.variance[c];
        const double weight = probability * independent / variance *
                              StudentWeight(explained.residual[c], std::sqrt(variance), kFreedom);
        const double share = explained.share[c], rest = 1.0 - share;
        const double pull = weight * explained.residual[c];
        sum.right[c] += share * pull;
        sum.right[3 + c] += rest * pull;
        sum.told(c, c) += weight * share * share;
        sum.told(3 + c, 3 + c) += weight * rest * rest;
        sum.told(c, 3 + c) += weight * share * rest;
        sum.told(3 + c, c) += weight * share * rest;
        sum.common.by_chance += weight * probe.learnt.by_chance;
        // A share that is wrong by a factor of 1 + e is made up for by the albedo as long as the
        // share stays.
        const double learnt_share = probe.cases[k].first_share[c];
        sum.common.per_share_error +=
            weight * share * (share - learnt_share + learnt_share * probe.learnt.per_share_error);
        share_squares += weight * share * share;
        weights += weight;
      }
    }
  }
  if (weights > 0.0) sum.common.by_chance /= weights;
  sum.common.per_share_error /= share_squares;
  return sum;
}

std::vector<LogLight> ForwardFilter::StartsOf(const std::vector<Reading>& readings) const {
  const LogLight factors = light_.array().exp();
  std::array<std::vector<double>, 2> changes, shares;  // Sunlit and shaded probes.
  for (const Reading& reading : readings) {
    const Probe& probe = probes_[reading.probe];
    const bool sunlit = probe.may_be_shaded && probe.log_odds_shade < 0.0;
    const Explained explained =
        Explain(probe, probe.cases[probe.log_odds_shade > 0.0 ? 1 : 0], reading, factors);
    changes[sunlit ? 0 : 1].push_back(Mean(explained.residual));
    shares[sunlit ? 0 : 1].push_back(Mean(explained.share));
  }
  std::vector<LogLight> starts{light_};
  if (changes[0].size() < kMinStartProbes) return starts;
  const double bright = std::exp(Median(changes[0])), in_sun = Median(shares[0]);
  const auto add = [&](double sun, double sky) {
    LogLight start = light_;
    start.head<3>().array() += std::log(sun);
    start.tail<3>().array() += std::log(sky);
    starts.push_back(start);
  };
  if (std::fabs(bright - 1.0) < kMinStartChange) return starts;
  add(std::max(kFaintest, 1.0 + (bright - 1.0) / in_sun), 1.0);
  if (changes[1].size() < kMinStartProbes) return starts;
  const auto split = SplitLight(bright, std::exp(Median(changes[1])), in_sun, Median(shares[1]));
  if (split) add(split->sun, split->sky);
  return starts;
}

ForwardFilter::Fitted ForwardFilter::FitFrom(const LogLight& start,
                                             const std::vector<Reading>& readings,
                                             double seconds) const {
  const LogLightMatrix channels = ChannelPrior();
  LightWalk walk({0.0, seconds});
  Fitted fitted{.light = start};
  if (start != light_) walk.Learn({light_, start});
  for (int i = 0; i < kMaxRounds; ++i) {
    const bool starting = static_cast<std::size_t>(i) < kNoiseScales.size();
    fitted.sum = AddUp(readings, fitted.light, starting ? kNoiseScales[i] : 1.0);
    fitted.prior = Inverse(covariance_ + Inverse(walk.Precision(0)));
    LogLight step = (fitted.sum.told + fitted.prior + channels)
                        .ldlt()
                        .solve(fitted.sum.right + fitted.prior * (light_ - fitted.light) -
                               channels * fitted.light);
    const double largest = step.lpNorm<Eigen::Infinity>();
    if (largest > kLargestStep) step *= kLargestStep / largest;
    fitted.light += step;
    walk.Learn({light_, fitted.light});
    if (!starting && largest < kConverged) break;
  }
  const LogLight moved = fitted.light - light_;
  fitted.cost = fitted.sum.cost + 0.5 * moved.dot(fitted.prior * moved) -
                0.5 * std::log(fitted.prior.determinant());
  return fitted;
}

LogLightMatrix ForwardFilter::Fit(const std::vector<Reading>& readings, double seconds) {
  // From the light before alone, a cloud would pass for a darker exposure where little shade is in
  // view.
  std::optional<Fitted> best;
  for (const LogLight& start : StartsOf(readings)) {
    const Fitted fitted = FitFrom(start, readings, seconds);
    if (!best || fitted.cost < best->cost) best = fitted;
  }
  light_ = best->light;
  covariance_ = Inverse(best->sum.told + best->prior + ChannelPrior());
  // What is not seen stays as uncertain as it was.
  const double known = std::max(0.0, 1.0 - Variance(covariance_) / Variance(Inverse(best->prior)));
  const CommonError& common = best->sum.common;
  common_.by_chance += known * (common.by_chance - common_.by_chance);
  common_.per_share_error += known * (common.per_share_error - common_.per_share_error);
  return best->sum.told;
}

double ForwardFilter::LogRatioError() const {
  return std::hypot(std::sqrt(Variance(covariance_)), common_.by_chance,
                    kCommonShareSpread * common_.per_share_error);
}

void ForwardFilter::TestForChange(const std::vector<Reading>& readings) {
  const LogLight factors = light_.array().exp();
  // Steady light explains the readings by an exposure alone.
  LogLight steady = LogLight::Zero();
  for (int c = 0; c < 3; ++c) {
    std::vector<double> residuals;
    for (const Reading& reading : readings) {
      const Probe& probe = probes_[reading.probe];
      const Case& as = probe.cases[probe.log_odds_shade > 0.0 ? 1 : 0];
      residuals.push_back(Explain(probe, as, reading, LogLight::Ones()).residual[c]);
    }
    steady[c] = steady[3 + c] = residuals.empty() ? 0.0 : Median(std::move(residuals));
  }
  const LogLight steady_factors = steady.array().exp();
  const double independent = std::min(
      1.0, kIndependentProbes / std::max<double>(1.0, static_cast<double>(readings.size())));
  double gain = 0.0;
  for (const Reading& reading : readings) {
    const Probe& probe = probes_[reading.probe];
    const Case& as = probe.cases[probe.log_odds_shade > 0.0 ? 1 : 0];
    gain += independent * (Cost(Explain(probe, as, reading, steady_factors), 1.0) -
                           Cost(Explain(probe, as, reading, factors), 1.0));
  }
  const bool differs = std::fabs(std::expm1(RatioDirection().dot(light_))) > kMinChange;
  evidence_ = differs ? std::max(0.0, evidence_ + gain) : 0.0;
  if (evidence_ > kConclusive) changes_ = true;
}

void ForwardFilter::Learn(const std::vector<Reading>& readings) {
  const LogLight factors = light_.array().exp();
  for (const Reading& reading : readings) {
    Probe& probe = probes_[reading.probe];
    std::array<Explained, 2> explained;
    for (std::size_t k = 0; k < explained.size(); ++k) {
      explained[k] = Explain(probe, probe.cases[k], reading, factors);
    }
    if (probe.may_be_shaded) {
      probe.log_odds_shade =
          std::clamp(probe.log_odds_shade + Cost(explained[0], 1.0) - Cost(explained[1], 1.0),
                     -kMaxShadeOdds, kMaxShadeOdds);
    }
    const std::size_t likely = probe.log_odds_shade > 0.0 ? 1 : 0;
    double square = 0.0;
    for (std::size_t k = 0; k < explained.size(); ++k) {
      Case& as = probe.cases[k];
      for (int c = 0; c < 3; ++c) {
        const double share = explained[k].share[c], rest = 1.0 - share;
        const double residual = explained[k].residual[c];
        const double weight =
            StudentWeight(residual, std::sqrt(explained[k].variance[c]), kFreedom);
        const double of_light = share * share * covariance_(c, c) +
                                rest * rest * covariance_(3 + c, 3 + c) +
                                2.0 * share * rest * covariance_(c, 3 + c);
        const double noise =
            probe.noise_square + of_light + Square(kShareSpread * (share - as.share[c]));
        const double gain = as.variance[c] / (as.variance[c] + noise / weight);
        as.log_albedo[c] += gain * residual;
        as.share[c] += gain * (share - as.share[c]);
        as.variance[c] *= 1.0 - gain;
        if (k == likely) square += weight * residual * residual / 3;
      }
    }
    const double count = std::min(kUsualNoiseReadings + probe.readings, kNoiseReadings);
    probe.noise_square =
        std::max(Square(kMinNoise), probe.noise_square + (square - probe.noise_square) / count);
    ++probe.readings;
  }
}

void ForwardFilter::SetUsualNoise(const std::vector<Reading>& readings) {
  std::vector<double> squares;
  squares.reserve(readings.size());
  for (const Reading& reading : readings) squares.push_back(probes_[reading.probe].noise_square);
  if (!squares.empty()) usual_noise_square_ = Median(std::move(squares));
}

void ForwardFilter::LearnFirst(const Reading& reading, Probe* probe) const {
  const LogLight factors = light_.array().exp();
  probe->noise_square = usual_noise_square_;
  probe->readings = 1;
  probe->learnt = {std::hypot(std::sqrt(Variance(covariance_)), common_.by_chance),
                   common_.per_share_error};
  for (Case& as : probe->cases) {
    const Explained explained = Explain(*probe, as, reading, factors);
    as.log_albedo = explained.residual;
    as.share = as.first_share = explained.share;
    as.variance.fill(probe->noise_square);
  }
}

FrameLight ForwardFilter::Add(const ProbedFrame& frame) {
  std::vector<Reading> known, first_seen;
  for (std::size_t k = 0; k < frame.probes.size(); ++k) {
    const std::size_t probe = frame.probes[k];
    if (probe >= probes_.size()) continue;
    Reading reading{probe, {}};
    for (int c = 0; c < 3; ++c) {
      reading.log_linear[c] = std::log(std::max<double>(frame.linear[k][c], kDarkest));
    }
    (probes_[probe].readings > 0 ? known : first_seen).push_back(reading);
  }
  LogLightMatrix told = LogLightMatrix::Zero();
  if (last_ns_) {
    told = Fit(known, 1e-9 * static_cast<double>(frame.timestamp_ns - *last_ns_));
    TestForChange(known);
    Learn(known);
    SetUsualNoise(known);
  }
  last_ns_ = frame.timestamp_ns;
  for (const Reading& reading : first_seen) LearnFirst(reading, &probes_[reading.probe]);

  FrameLight found{.frame_index = frame.frame_index, .timestamp_ns = frame.timestamp_ns};
  found.sun = {std::exp(light_[0]), std::exp(light_[1]), std::exp(light_[2])};
  found.sky = {std::exp(light_[3]), std::exp(light_[4]), std::exp(light_[5])};
  found.log_ratio_error = LogRatioError();
  found.source = SourceOf(told, found.log_ratio_error);
  return found;
}

}  // namespace pleinair::compositor
