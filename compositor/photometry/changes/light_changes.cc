#include "compositor/photometry/changes/light_changes.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "compositor/photometry/changes/light_equations.h"
#include "compositor/photometry/changes/light_walk.h"
#include "compositor/photometry/changes/probe_fit.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {
namespace {

// Largest number of rounds, and the logarithmic step at which they end.
constexpr int kMaxRounds = 40;
constexpr double kConverged = 0.002;
// Rounds with a large noise, the same for all probes.
constexpr int kStartRounds = 4;
// Rounds after which unmodelled shade is decided.
constexpr std::array kShadeRounds{2, 6};
// Probes in shade that every frame needs to show how deep its shadows are. Quantile of the frames'
// depths that counts as the full sun's, and how much less, logarithmic, is still full sun.
constexpr std::size_t kMinShadedProbes = 5;
constexpr double kDeepest = 0.9, kAsDeep = 0.1;
// Independent probes of a frame: errors of neighbours are alike.
constexpr double kIndependentProbes = 100.0;
// Error of the modelled sun over sky that all probes have in common, relative.
constexpr double kModelError = 0.05;
// Largest standard deviation of the logarithm of sun over sky for a reading of this kind.
constexpr double kToldBySurfaces = 0.1, kToldByColors = 0.3;
// A change of sun over sky, as a part of the full sun: beyond so many standard deviations and this
// much, in so many frames in a row.
constexpr double kChangeSigmas = 4.0, kMinChange = 0.05;
constexpr int kChangeFrames = 3;
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
        independent_(frames.size(), 1.0) {
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

  /// Albedos by the reference frames, and every frame's light by its brightness alone.
  void Start() {
    if (reference_.empty()) reference_ = FramesInFullSun();
    std::vector<bool> counts(now_.light.size(), false);
    for (const std::size_t t : reference_) counts[t] = true;
    std::vector<std::vector<double>> brightness(now_.light.size());
    for (ProbeFit& probe : probes_) {
      probe.SetAlbedo(factors_, counts);
      const bool known = std::any_of(probe.readings().begin(), probe.readings().end(),
                                     [&](const auto& reading) { return counts[reading.frame]; });
      if (!known) continue;
      for (const ProbeReading& reading : probe.readings()) {
        brightness[reading.frame].push_back(probe.Brightness(reading));
      }
    }
    for (std::size_t t = 0; t < brightness.size(); ++t) {
      if (!brightness[t].empty()) now_.light[t].setConstant(Median(brightness[t]));
    }
    UpdateFactors();
    std::fill(counts.begin(), counts.end(), true);
    ParallelFor(probes_.size(), 0, [&](std::size_t i) { probes_[i].SetAlbedo(factors_, counts); });
  }

  /// Runs the rounds. `shares`: whether sun over sky of the probes is estimated, too.
  void Converge(bool shares) {
    for (int i = 0; i < kMaxRounds; ++i) {
      const double moved = Iterate(shares);
      // At first every probe counts: a shadow that stays as it was would pass for an outlier.
      const bool starting = !shares && i < kStartRounds;
      if (!starting) UpdateNoise();
      const bool settling = starting || (shares && i <= kShadeRounds.back());
      if (shares && std::find(kShadeRounds.begin(), kShadeRounds.end(), i) != kShadeRounds.end()) {
        DecideShade();
      }
      if (moved < kConverged && !settling) break;
    }
  }

  /// True if sun over sky changes, as a part of the full sun, by more than the readings' noise.
  bool Changes() const {
    int in_a_row = 0;
    const int needed = std::min<int>(kChangeFrames, static_cast<int>(now_.light.size()));
    for (std::size_t t = 0; t < now_.light.size(); ++t) {
      const double ratio = ResultOf(t).LogRatio();
      const double noise = kChangeSigmas * ErrorOfReadings(t) * std::exp(ratio);
      const bool differs = std::fabs(std::expm1(ratio)) > std::max(kMinChange, noise);
      in_a_row = differs ? in_a_row + 1 : 0;
      if (in_a_row >= needed) return true;
    }
    return false;
  }

  std::vector<FrameLight> Result() const {
    std::vector<FrameLight> frames(now_.light.size());
    for (std::size_t t = 0; t < frames.size(); ++t) frames[t] = ResultOf(t);
    return frames;
  }

 private:
  /// One round; returns the largest step of a frame's light.
  double Iterate(bool shares) {
    ParallelFor(probes_.size(), 0, [&](std::size_t i) {
      probes_[i].Linearize(factors_, now_.planes[probes_[i].plane()], independent_, shares);
    });
    const LightEquations equations(probes_, *walk_, reference_, now_, shares);
    told_ = equations.told();
    covariance_ = equations.Covariance();
    LightUnknowns step = equations.Solve();
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

  /// The frames with the deepest shadows; the brightest ones where too few probes are in shade.
  std::vector<std::size_t> FramesInFullSun() const {
    // Brightness about each probe's usual one, by frame: of probes in the sun and of others.
    std::array<std::vector<std::vector<double>>, 2> about;
    about.fill(std::vector<std::vector<double>>(now_.light.size()));
    for (const ProbeFit& probe : probes_) {
      std::vector<double> values;
      for (const ProbeReading& reading : probe.readings()) {
        values.push_back(probe.Brightness(reading));
      }
      if (values.empty()) continue;
      const double usual = Median(values);
      for (std::size_t k = 0; k < values.size(); ++k) {
        about[probe.IsSunlit() ? 1 : 0][probe.readings()[k].frame].push_back(values[k] - usual);
      }
    }
    const auto& [shaded, sunlit] = about;
    const bool compare = std::all_of(shaded.begin(), shaded.end(), [](const auto& values) {
      return values.size() >= kMinShadedProbes;
    });
    std::vector<double> depths(now_.light.size(), -INFINITY), known;
    for (std::size_t t = 0; t < depths.size(); ++t) {
      if (sunlit[t].empty()) continue;
      depths[t] = Median(sunlit[t]) - (compare ? Median(shaded[t]) : 0.0);
      known.push_back(depths[t]);
    }
    std::vector<std::size_t> frames;
    if (known.empty()) return frames;
    const double full = Quantile(known, kDeepest) - kAsDeep;
    for (std::size_t t = 0; t < depths.size(); ++t) {
      if (depths[t] >= full) frames.push_back(t);
    }
    return frames;
  }

  void UpdateFactors() {
    for (std::size_t t = 0; t < factors_.size(); ++t) factors_[t] = now_.light[t].array().exp();
  }

  void DecideShade() {
    ParallelFor(probes_.size(), 0, [&](std::size_t i) {
      probes_[i].DecideShade(factors_, now_.planes[probes_[i].plane()]);
    });
  }

  /// Standard deviation of log(sun over sky), mean of the channels, by the readings alone.
  double ErrorOfReadings(std::size_t t) const {
    LogLight ratio;
    ratio << 1.0, 1.0, 1.0, -1.0, -1.0, -1.0;
    ratio /= 3.0;
    return std::sqrt(ratio.dot(covariance_[t] * ratio));
  }

  FrameLight ResultOf(std::size_t t) const {
    FrameLight frame;
    const LogLight& log = now_.light[t];
    frame.sun = {std::exp(log[0]), std::exp(log[1]), std::exp(log[2])};
    frame.sky = {std::exp(log[3]), std::exp(log[4]), std::exp(log[5])};
    // With an error e of the common share, the same brightness means a sun of a + e (1 - a).
    frame.log_ratio_error =
        std::hypot(ErrorOfReadings(t), kModelError * std::expm1(-frame.LogRatio()));
    using Source = FrameLight::Source;
    const double by_surfaces = ErrorBySurfaces(told_[t]);
    if (told_[t].isZero()) {
      frame.source = Source::kHeld;
    } else if (by_surfaces < kToldBySurfaces) {
      frame.source = Source::kSurfaces;
    } else {
      frame.source = frame.log_ratio_error < kToldByColors ? Source::kColors : Source::kTotalOnly;
    }
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

  /// Standard deviation of log(sun over sky) by single channels: surfaces in sun and shade.
  static double ErrorBySurfaces(const LogLightMatrix& information) {
    double precision = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double a = information(c, c), b = information(c, 3 + c), d = information(3 + c, 3 + c);
      // Inverse of the 2 × 2 block, times (1, -1) on both sides.
      const double determinant = a * d - b * b, all = a + d + 2 * b;
      if (all > 0.0) precision += determinant / all;
    }
    return precision > 0.0 ? 1.0 / std::sqrt(precision) : INFINITY;
  }

  std::vector<std::size_t> reference_;
  LightWalk* walk_;
  LightUnknowns now_;
  std::vector<LogLight> factors_;    // Exponentials of the light.
  std::vector<double> independent_;  // Factor on each frame's evidence.
  std::vector<ProbeFit> probes_;
  double noise_ = 0.3;                             // Usual noise of a probe, relative.
  std::vector<LogLightMatrix> told_, covariance_;  // Of the last round: LightEquations.
};

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
  const auto conclude = [&] {
    changes.frames = fit.Result();
    for (std::size_t t = 0; t < frames.size(); ++t) {
      changes.frames[t].frame_index = frames[t].frame_index;
      changes.frames[t].timestamp_ns = frames[t].timestamp_ns;
    }
    changes.changes = fit.Changes();
  };
  fit.Converge(false);
  conclude();
  // In steady light the shares of the probes cannot be told.
  if (!changes.changes) return changes;
  fit.Converge(true);
  conclude();
  return changes;
}

}  // namespace pleinair::compositor
