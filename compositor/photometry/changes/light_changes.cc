#include "compositor/photometry/changes/light_changes.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "compositor/photometry/changes/light_equations.h"
#include "compositor/photometry/changes/light_source.h"
#include "compositor/photometry/changes/light_start.h"
#include "compositor/photometry/changes/light_walk.h"
#include "compositor/photometry/changes/probe_fit.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {
namespace {

// Largest number of rounds, and the logarithmic step at which they end.
constexpr int kMaxRounds = 40;
constexpr double kConverged = 0.002;
// Part of the residual that a round leaves, while the step is larger than this and afterwards.
constexpr double kCoarse = 1e-2, kSettled = 0.01, kFine = 1e-4;
// Relative change of the noise, likewise.
constexpr double kNoiseConverged = 0.05;
// Largest number of rounds of steady light, which need not explain changing light exactly.
constexpr int kMaxSteadyRounds = 12;
// The step at which a noise that is large, and the same for all probes, gives way to that of each.
constexpr double kStarted = 0.05;
// Rounds after which unmodelled shade is decided.
constexpr std::array kShadeRounds{2, 6};
// Independent probes of a frame: errors of neighbours are alike.
constexpr double kIndependentProbes = 100.0;
// A change of sun over sky: by so much of the full sun, in so many frames in a row, each of which
// steady light explains worse by this, the logarithm of the likelihoods' ratio. It is large, since
// errors of the model are alike in many probes.
constexpr double kMinChange = 0.05;
constexpr std::size_t kChangeFrames = 3;
constexpr double kConclusive = 20.0;
// Samples of the posterior, and how many frames on either side have errors alike.
constexpr std::uint32_t kSamples = 8;
constexpr std::size_t kAlike = 2;
// Largest step of a logarithm in one round.
constexpr double kLargestStep = 0.5;

/// Maximum a posteriori fit by Gauss-Newton steps with reweighting.
class Fit {
 public:
  Fit(const std::vector<ProbedFrame>& frames, const std::vector<LightProbe>& probes,
      const std::vector<ProbeLight>& light, std::vector<std::size_t> reference, LightWalk* walk)
      : reference_(std::move(reference)),
        walk_(walk),
        now_(frames.size(), 0),
        factors_(frames.size(), LogLight::Ones()),
        independent_(frames.size(), 1.0),
        ratio_variances_(frames.size(), 0.0) {
    std::map<std::array<int, 3>, std::size_t> planes;
    for (std::size_t i = 0; i < light.size(); ++i) {
      const auto plane = planes.try_emplace(PlaneOf(0, probes[i].normal).second, planes.size());
      probes_.emplace_back(light[i], plane.first->second);
    }
    now_.planes.assign(planes.size(), PlaneError::Zero());
    for (std::size_t t = 0; t < frames.size(); ++t) {
      const std::size_t count = frames[t].probes.size();
      for (std::size_t k = 0; k < count; ++k) {
        probes_[frames[t].probes[k]].Add(t, frames[t].linear[k]);
      }
      independent_[t] =
          std::min(1.0, kIndependentProbes / std::max<double>(1.0, static_cast<double>(count)));
    }
  }

  void Start() {
    LightStart start = StartLight(probes_, now_.light.size(), reference_);
    reference_ = std::move(start.reference);
    now_.light = std::move(start.light);
    UpdateFactors();
    ParallelFor(probes_.size(), 0, [&](std::size_t i) { probes_[i].SetAlbedo(factors_); });
  }

  void Converge() {
    bool starting = true;
    double moved = kLargestStep;
    for (int i = 0; i < kMaxRounds; ++i) {
      // Coarsely while the steps are large (Dembo, Eisenstat & Steihaug 1982).
      const double precision = moved > kSettled ? kCoarse : kFine;
      moved = Iterate(precision);
      // At first every probe counts: a shadow that stays as it was would pass for an outlier.
      if (moved < kStarted) starting = false;
      const double noise_before = noise_;
      if (!starting) UpdateNoise();
      const bool settling = starting || i <= kShadeRounds.back() ||
                            std::fabs(noise_ / noise_before - 1.0) > kNoiseConverged;
      if (std::find(kShadeRounds.begin(), kShadeRounds.end(), i) != kShadeRounds.end()) {
        DecideShade();
      }
      if (moved < kConverged && precision == kFine && !settling) break;
    }
  }

  /// Lets only the exposure change from now on, on a walk of its own; noise and shade stay as they
  /// are.
  void Hold(LightWalk* walk) {
    walk_ = walk;
    walk_->Hold();
    LogLight balance = LogLight::Zero();
    for (const LogLight& light : now_.light) {
      balance += (light.array() - light.mean()).matrix() / static_cast<double>(now_.light.size());
    }
    for (LogLight& light : now_.light) light = balance.array() + light.mean();
    UpdateFactors();
    double moved = kLargestStep;
    for (int i = 0; i < kMaxSteadyRounds && moved > kConverged; ++i) {
      moved = Iterate(moved > kSettled ? kCoarse : kFine);
    }
  }

  /// Negative logarithm of the readings' likelihood, by frame.
  std::vector<double> Costs() const {
    std::vector<double> costs(factors_.size(), 0.0);
    for (const ProbeFit& probe : probes_) {
      probe.Cost(factors_, now_.planes[probe.plane()], independent_, &costs);
    }
    return costs;
  }

  /// Uncertainty of sun over sky with that of albedos and shares, by samples of the posterior. The
  /// fit cannot go on afterwards.
  void SampleErrors() {
    const std::size_t count = now_.light.size();
    std::vector<double> squares(count, 0.0);
    const auto probes = static_cast<std::uint32_t>(probes_.size());
    for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
      ParallelFor(probes_.size(), 0, [&](std::size_t i) {
        probes_[i].PutNoise(sample * probes + static_cast<std::uint32_t>(i));
      });
      LightEquations equations(probes_, *walk_, reference_,
                               LightUnknowns(count, now_.planes.size()));
      equations.AddPriorNoise(sample);
      const LightUnknowns error = equations.Solve(kCoarse);
      for (std::size_t t = 0; t < count; ++t) {
        const double ratio = RatioDirection().dot(error.light[t]);
        squares[t] += ratio * ratio / (ratio_variances_[t] * kSamples);
      }
    }
    // Few samples, but frames nearby are alike.
    const std::vector<double> variances = ratio_variances_;
    for (std::size_t t = 0; t < count; ++t) {
      const std::size_t begin = t < kAlike ? 0 : t - kAlike, end = std::min(count, t + kAlike + 1);
      double sum = 0.0;
      for (std::size_t s = begin; s < end; ++s) sum += squares[s];
      ratio_variances_[t] = variances[t] * sum / static_cast<double>(end - begin);
    }
  }

  std::vector<FrameLight> Result() const {
    std::vector<FrameLight> frames(now_.light.size());
    for (std::size_t t = 0; t < frames.size(); ++t) frames[t] = ResultOf(t);
    return frames;
  }

 private:
  /// One round, solved to this part of the residual; returns the largest step of a frame's light.
  double Iterate(double precision) {
    ParallelFor(probes_.size(), 0, [&](std::size_t i) {
      probes_[i].Linearize(factors_, now_.planes[probes_[i].plane()], independent_);
    });
    const LightEquations equations(probes_, *walk_, reference_, now_);
    told_ = equations.told();
    const std::vector<LogLightMatrix> covariances = equations.Covariance();
    for (std::size_t t = 0; t < covariances.size(); ++t) {
      ratio_variances_[t] = RatioDirection().dot(covariances[t] * RatioDirection());
    }
    LightUnknowns step = equations.Solve(precision);
    if (const double largest = step.Largest(); largest > kLargestStep) {
      step.Scale(kLargestStep / largest);
    }
    ParallelFor(probes_.size(), 0, [&](std::size_t i) {
      probes_[i].Move(step.light, step.planes[probes_[i].plane()]);
    });
    now_.Add(step, 1.0);
    UpdateFactors();
    walk_->Learn(now_.light);
    return step.Largest();
  }

  void UpdateFactors() {
    for (std::size_t t = 0; t < factors_.size(); ++t) factors_[t] = now_.light[t].array().exp();
  }

  void DecideShade() {
    ParallelFor(probes_.size(), 0, [&](std::size_t i) {
      probes_[i].DecideShade(factors_, now_.planes[probes_[i].plane()]);
    });
  }

  FrameLight ResultOf(std::size_t t) const {
    FrameLight frame;
    const LogLight& log = now_.light[t];
    frame.sun = {std::exp(log[0]), std::exp(log[1]), std::exp(log[2])};
    frame.sky = {std::exp(log[3]), std::exp(log[4]), std::exp(log[5])};
    frame.log_ratio_error =
        std::hypot(std::sqrt(ratio_variances_[t]), CommonModelError(frame.LogRatio()));
    frame.source = SourceOf(told_[t], frame.log_ratio_error);
    return frame;
  }

  /// The usual noise is the median of the probes'.
  void UpdateNoise() {
    ParallelFor(probes_.size(), 0, [&](std::size_t i) { probes_[i].SetNoise(noise_); });
    std::vector<double> noises;
    for (const ProbeFit& probe : probes_) {
      if (!probe.empty()) noises.push_back(probe.noise());
    }
    if (!noises.empty()) noise_ = Median(noises);
  }

  std::vector<std::size_t> reference_;
  LightWalk* walk_;
  LightUnknowns now_;
  std::vector<LogLight> factors_;    // Exponentials of the light.
  std::vector<double> independent_;  // Factor on each frame's evidence.
  std::vector<ProbeFit> probes_;
  double noise_ = 0.3;                   // Usual noise of a probe, relative.
  std::vector<LogLightMatrix> told_;     // Of the last round: LightEquations.
  std::vector<double> ratio_variances_;  // Of log(sun over sky), mean of the channels.
};

/// True if in some frames in a row sun over sky differs, as a part of the full sun, and steady
/// light explains them worse.
bool Differ(const std::vector<FrameLight>& frames, const std::vector<double>& costs,
            const std::vector<double>& steady_costs) {
  const std::size_t needed = std::min<std::size_t>(kChangeFrames, frames.size());
  std::size_t in_a_row = 0;
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const bool differs = std::fabs(std::expm1(frames[t].LogRatio())) > kMinChange;
    in_a_row = differs && steady_costs[t] - costs[t] > kConclusive ? in_a_row + 1 : 0;
    if (in_a_row >= needed) return true;
  }
  return false;
}

}  // namespace

LightChanges FitLightChanges(const std::vector<ProbedFrame>& frames,
                             const std::vector<LightProbe>& probes,
                             const std::vector<ProbeLight>& light,
                             const std::vector<std::size_t>& reference) {
  LightChanges changes;
  if (frames.empty()) return changes;
  std::vector<double> seconds;
  seconds.reserve(frames.size());
  for (const ProbedFrame& frame : frames) {
    seconds.push_back(1e-9 * static_cast<double>(frame.timestamp_ns));
  }
  LightWalk walk(seconds);
  Fit fit(frames, probes, light, reference, &walk);
  fit.Start();
  fit.Converge();
  Fit steady = fit;
  LightWalk still = walk;
  steady.Hold(&still);
  changes.changes = Differ(fit.Result(), fit.Costs(), steady.Costs());
  if (changes.changes) fit.SampleErrors();
  changes.frames = changes.changes ? fit.Result() : steady.Result();
  for (std::size_t t = 0; t < frames.size(); ++t) {
    changes.frames[t].frame_index = frames[t].frame_index;
    changes.frames[t].timestamp_ns = frames[t].timestamp_ns;
  }
  return changes;
}

}  // namespace pleinair::compositor
