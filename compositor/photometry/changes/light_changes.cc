#include "compositor/photometry/changes/light_changes.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "compositor/photometry/changes/light_walk.h"

namespace pleinair::compositor {
namespace {

using Rgb = std::array<double, 3>;

// Rounds of the fit: with the shares of the model, then with estimated ones.
constexpr int kRounds = 6, kShareRounds = 6;
// Smallest relative noise of a probe: errors of the modelled shares of sun and sky.
constexpr double kMinNoise = 0.01;
// Degrees of freedom of the residuals' distribution, for people and cars among the probes.
constexpr double kFreedom = 4.0;
// Independent probes of a frame: errors of neighbours are alike.
constexpr double kIndependentProbes = 100.0;
// Standard deviation of a channel's light from the channels' mean, logarithmic.
constexpr double kChannelSpread = 0.1;
// Logarithmic cost by which unmodelled shade must explain a probe better than the phantoms do.
constexpr double kShadeEvidence = 3.0;
// Error of a probe's modelled sun over sky, logarithmic: one standard deviation, and the errors
// that are tried.
constexpr double kShareSpread = 0.2;
constexpr std::array kShareErrors{0.0, -0.1, 0.1, -0.2, 0.2, -0.35, 0.35, -0.5, 0.5};
// Frames from which a probe's albedo, share and noise are estimated, at most. Frames that count as
// much as the common noise.
constexpr std::size_t kProbeFrames = 60;
constexpr double kCommonNoiseFrames = 5.0;
// Error of a change of sun over sky by errors of the modelled shares that all probes have in
// common, as a part of its logarithm.
constexpr double kModelError = 0.04;
// Largest standard deviation of the logarithm of sun over sky for a reading of this kind.
constexpr double kToldBySurfaces = 0.1, kToldByColors = 0.3;
// A change of sun over sky, logarithmic: beyond so many standard deviations and this much, in so
// many frames in a row.
constexpr double kChangeSigmas = 4.0, kMinChange = 0.05;
constexpr int kChangeFrames = 3;

/// One probe in one frame.
struct Reading {
  std::uint32_t probe;
  Rgb log_linear;
};

/// The same, listed by probe.
struct FrameReading {
  std::size_t frame;
  Rgb log_linear;
};

/// What is estimated of a probe.
struct ProbeState {
  std::optional<Rgb> log_albedo;  // A common factor included.
  double share_error = 0.0;       // Logarithm of its sun over sky, to be added to the model's.
  bool shaded = false;            // By unmodelled geometry.
  double noise = 0.05;            // Relative, one standard deviation.
};

// From a median absolute deviation to the standard deviation of a normal distribution.
constexpr double kDeviationOfMedian = 1.4826;

/// Cost of a residual: negative logarithm of Student's density, up to a constant.
double Cost(double residual, double noise) {
  const double z = residual / noise;
  return 0.5 * (kFreedom + 1.0) * std::log1p(z * z / kFreedom);
}

class Fit {
 public:
  Fit(const std::vector<ProbedFrame>& frames, const std::vector<ProbeLight>& light,
      const std::vector<std::size_t>& reference)
      : light_(light),
        reference_(reference),
        readings_(frames.size()),
        by_probe_(light.size()),
        logs_(frames.size(), LogLight::Zero()),
        factors_(frames.size(), LogLight::Ones()),
        probes_(light.size()) {
    for (std::size_t t = 0; t < frames.size(); ++t) {
      for (std::size_t k = 0; k < frames[t].probes.size(); ++k) {
        const auto& linear = frames[t].linear[k];
        const Rgb log_linear{std::log(std::max<double>(linear[0], 1e-6)),
                             std::log(std::max<double>(linear[1], 1e-6)),
                             std::log(std::max<double>(linear[2], 1e-6))};
        readings_[t].push_back({frames[t].probes[k], log_linear});
        by_probe_[frames[t].probes[k]].push_back({t, log_linear});
      }
    }
  }

  /// Albedos by the reference frames, and every frame's light by its brightness alone.
  void Start() {
    ParallelFor(probes_.size(), 0, [&](std::size_t i) {
      std::vector<FrameReading> known;
      for (const FrameReading& reading : by_probe_[i]) {
        if (std::find(reference_.begin(), reference_.end(), reading.frame) != reference_.end()) {
          known.push_back(reading);
        }
      }
      if (!known.empty()) probes_[i].log_albedo = AlbedoOf(i, probes_[i], known);
    });
    ParallelFor(readings_.size(), 0, [&](std::size_t t) {
      std::vector<double> brighter;
      for (const Reading& reading : readings_[t]) {
        const ProbeState& probe = probes_[reading.probe];
        if (!probe.log_albedo) continue;
        const Rgb off = ResidualOf(reading.probe, probe, reading.log_linear, LogLight::Ones());
        brighter.push_back((off[0] + off[1] + off[2]) / 3);
      }
      if (!brighter.empty()) logs_[t].setConstant(Median(brighter));
    });
    UpdateFactors();
  }

  /// `shares`: whether sun over sky of the probes is estimated, too.
  void Iterate(LightWalk* walk, bool shares) {
    ParallelFor(probes_.size(), 0, [&](std::size_t i) { UpdateProbe(i, shares); });
    if (shares) CenterShares();
    UpdateNoise();
    evidence_.resize(readings_.size());
    errors_by_surfaces_.assign(readings_.size(), INFINITY);
    ParallelFor(readings_.size(), 0,
                [&](std::size_t t) { evidence_[t] = EvidenceOf(t, &errors_by_surfaces_[t]); });
    smoothed_ = walk->Smooth(evidence_);
    // The gauge: in the mean of the reference frames the light is 1.
    LogLight mean = LogLight::Zero();
    for (const std::size_t t : reference_) mean += smoothed_.light[t];
    mean /= std::max<double>(1.0, static_cast<double>(reference_.size()));
    for (std::size_t t = 0; t < logs_.size(); ++t) logs_[t] = smoothed_.light[t] - mean;
    UpdateFactors();
  }

  FrameLight ResultOf(std::size_t t) const {
    FrameLight frame;
    const LogLight& log = logs_[t];
    frame.sun = {std::exp(log[0]), std::exp(log[1]), std::exp(log[2])};
    frame.sky = {std::exp(log[3]), std::exp(log[4]), std::exp(log[5])};
    LogLight ratio;
    ratio << 1.0, 1.0, 1.0, -1.0, -1.0, -1.0;
    ratio /= 3.0;
    frame.log_ratio_error = std::hypot(std::sqrt(ratio.dot(smoothed_.covariance[t] * ratio)),
                                       kModelError * frame.LogRatio());
    using Source = FrameLight::Source;
    if (readings_[t].empty()) {
      frame.source = Source::kHeld;
    } else if (errors_by_surfaces_[t] < kToldBySurfaces) {
      frame.source = Source::kSurfaces;
    } else {
      frame.source = frame.log_ratio_error < kToldByColors ? Source::kColors : Source::kTotalOnly;
    }
    return frame;
  }

 private:
  void UpdateFactors() {
    for (std::size_t t = 0; t < logs_.size(); ++t) factors_[t] = logs_[t].array().exp();
  }

  /// Light of sun and of sky on a probe. `factors`: exponentials of a frame's light.
  std::array<Rgb, 2> Parts(std::size_t i, const ProbeState& probe, const LogLight& factors) const {
    const ProbeLight& light = light_[i];
    const LinearRgb of_sun =
        (light.direct * (probe.shaded ? 0.0 : light.sun_visibility) + light.reflected) *
        std::exp(probe.share_error);
    return {Rgb{of_sun.r * factors[0], of_sun.g * factors[1], of_sun.b * factors[2]},
            Rgb{light.sky.r * factors[3] + 1e-9, light.sky.g * factors[4] + 1e-9,
                light.sky.b * factors[5] + 1e-9}};
  }

  /// What a reading exceeds the model by, logarithmic.
  Rgb ResidualOf(std::size_t i, const ProbeState& probe, const Rgb& log_linear,
                 const LogLight& factors) const {
    const auto [sun, sky] = Parts(i, probe, factors);
    const Rgb albedo = probe.log_albedo.value_or(Rgb{});
    Rgb residual{};
    for (std::size_t c = 0; c < 3; ++c) {
      residual[c] = log_linear[c] - albedo[c] - std::log(sun[c] + sky[c]);
    }
    return residual;
  }

  /// The median over frames of what the model without albedo leaves.
  Rgb AlbedoOf(std::size_t i, ProbeState probe, const std::vector<FrameReading>& readings) const {
    probe.log_albedo = Rgb{};
    std::array<std::vector<double>, 3> values;
    for (const FrameReading& reading : readings) {
      const Rgb residual = ResidualOf(i, probe, reading.log_linear, factors_[reading.frame]);
      for (std::size_t c = 0; c < 3; ++c) values[c].push_back(residual[c]);
    }
    return {Median(values[0]), Median(values[1]), Median(values[2])};
  }

  /// A part of a probe's readings, evenly spread.
  std::vector<FrameReading> SomeOf(std::size_t i) const {
    const std::vector<FrameReading>& all = by_probe_[i];
    if (all.size() <= kProbeFrames) return all;
    std::vector<FrameReading> some;
    for (std::size_t k = 0; k < kProbeFrames; ++k) {
      some.push_back(all[(2 * k + 1) * all.size() / (2 * kProbeFrames)]);
    }
    return some;
  }

  /// The albedo, and with `shares` also sun over sky, that explain the readings best.
  void UpdateProbe(std::size_t i, bool shares) {
    const std::vector<FrameReading> readings = SomeOf(i);
    if (readings.empty()) return;
    ProbeState best = probes_[i];
    double least = INFINITY;
    const auto consider = [&](double share_error, bool shaded, double prior) {
      ProbeState probe = probes_[i];
      probe.share_error = share_error;
      probe.shaded = shaded;
      probe.log_albedo = AlbedoOf(i, probe, readings);
      double cost = prior;
      for (const FrameReading& reading : readings) {
        const Rgb off = ResidualOf(i, probe, reading.log_linear, factors_[reading.frame]);
        for (const double residual : off) cost += Cost(residual, probe.noise) / 3;
      }
      if (cost >= least) return;
      least = cost;
      best = probe;
    };
    if (!shares) {
      consider(0.0, false, 0.0);
    } else {
      const bool sunlit = light_[i].direct.g * light_[i].sun_visibility > 0.0;
      for (const double error : kShareErrors) {
        const double prior = 0.5 * error * error / (kShareSpread * kShareSpread);
        consider(error, false, prior);
        if (sunlit) consider(error, true, prior + kShadeEvidence);
      }
    }
    std::vector<double> off;
    for (const FrameReading& reading : readings) {
      const Rgb residual = ResidualOf(i, best, reading.log_linear, factors_[reading.frame]);
      off.push_back(std::fabs(residual[0] + residual[1] + residual[2]) / 3);
    }
    const double own = kDeviationOfMedian * Median(off), count = static_cast<double>(off.size());
    best.noise = std::sqrt((own * own * count + noise_ * noise_ * kCommonNoiseFrames) /
                           (count + kCommonNoiseFrames));
    probes_[i] = best;
  }

  /// The mean sun over sky of the probes is that of the estimated light.
  void CenterShares() {
    double sum = 0.0, weights = 0.0;
    for (std::size_t i = 0; i < probes_.size(); ++i) {
      const auto weight = static_cast<double>(by_probe_[i].size());
      sum += weight * probes_[i].share_error;
      weights += weight;
    }
    for (ProbeState& probe : probes_) probe.share_error -= sum / std::max(weights, 1.0);
  }

  /// The common noise: the median of the probes'.
  void UpdateNoise() {
    std::vector<double> noises;
    for (std::size_t i = 0; i < probes_.size(); ++i) {
      if (!by_probe_[i].empty()) noises.push_back(probes_[i].noise);
    }
    if (!noises.empty()) noise_ = std::max(kMinNoise, Median(noises));
    for (ProbeState& probe : probes_) probe.noise = std::max(probe.noise, noise_);
  }

  LightEvidence6 EvidenceOf(std::size_t t, double* error_by_surfaces) const {
    LightEvidence6 evidence;
    evidence.at = logs_[t];
    int count = 0;
    for (const Reading& reading : readings_[t]) {
      const ProbeState& probe = probes_[reading.probe];
      if (!probe.log_albedo) continue;
      ++count;
      const auto [sun, sky] = Parts(reading.probe, probe, factors_[t]);
      const double variance = probe.noise * probe.noise;
      for (int c = 0; c < 3; ++c) {
        const double total = sun[c] + sky[c];
        const double residual = reading.log_linear[c] - (*probe.log_albedo)[c] - std::log(total);
        const double weight =
            (kFreedom + 1.0) / (kFreedom + residual * residual / variance) / variance;
        const double of_sun = sun[c] / total, of_sky = sky[c] / total;
        evidence.gradient[c] += weight * of_sun * residual;
        evidence.gradient[3 + c] += weight * of_sky * residual;
        evidence.information(c, c) += weight * of_sun * of_sun;
        evidence.information(3 + c, 3 + c) += weight * of_sky * of_sky;
        evidence.information(c, 3 + c) += weight * of_sun * of_sky;
        evidence.information(3 + c, c) += weight * of_sun * of_sky;
      }
    }
    if (count == 0) return evidence;
    *error_by_surfaces = ErrorBySurfaces(evidence.information);
    const double independent = std::min(1.0, kIndependentProbes / count);
    evidence.gradient *= independent;
    evidence.information *= independent;
    // Channels change nearly alike.
    for (const int first : {0, 3}) {
      Eigen::Matrix3d spread = Eigen::Matrix3d::Constant(-1.0 / 3.0);
      spread.diagonal().array() += 1.0;
      spread /= kChannelSpread * kChannelSpread;
      evidence.gradient.segment<3>(first) -= spread * logs_[t].segment<3>(first);
      evidence.information.block<3, 3>(first, first) += spread;
    }
    return evidence;
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

  const std::vector<ProbeLight>& light_;
  const std::vector<std::size_t>& reference_;
  std::vector<std::vector<Reading>> readings_;       // Per frame.
  std::vector<std::vector<FrameReading>> by_probe_;  // The same.
  std::vector<LogLight> logs_, factors_;             // Per frame.
  std::vector<ProbeState> probes_;
  double noise_ = 0.05;  // Usual noise of a probe, relative.
  std::vector<LightEvidence6> evidence_;
  std::vector<double> errors_by_surfaces_;  // Per frame.
  SmoothedLight smoothed_;
};

bool Changes(const std::vector<FrameLight>& frames) {
  int in_a_row = 0;
  const int needed = std::min<int>(kChangeFrames, static_cast<int>(frames.size()));
  for (const FrameLight& frame : frames) {
    const bool differs =
        std::fabs(frame.LogRatio()) > std::max(kMinChange, kChangeSigmas * frame.log_ratio_error);
    in_a_row = differs ? in_a_row + 1 : 0;
    if (in_a_row >= needed) return true;
  }
  return false;
}

}  // namespace

LightChanges FitLightChanges(const std::vector<ProbedFrame>& frames,
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
  Fit fit(frames, light, reference);
  fit.Start();
  const auto conclude = [&] {
    changes.frames.clear();
    for (std::size_t t = 0; t < frames.size(); ++t) {
      FrameLight frame = fit.ResultOf(t);
      frame.frame_index = frames[t].frame_index;
      frame.timestamp_ns = frames[t].timestamp_ns;
      changes.frames.push_back(frame);
    }
    changes.changes = Changes(changes.frames);
  };
  for (int i = 0; i < kRounds; ++i) fit.Iterate(&walk, false);
  conclude();
  // In steady light the shares of the probes cannot be told.
  if (!changes.changes) return changes;
  for (int i = 0; i < kShareRounds; ++i) fit.Iterate(&walk, true);
  conclude();
  return changes;
}

}  // namespace pleinair::compositor
