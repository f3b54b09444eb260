#include "compositor/photometry/estimate/light_posterior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "compositor/photometry/estimate/cell_model.h"
#include "compositor/photometry/estimate/level_evidence.h"
#include "compositor/photometry/estimate/sky_color.h"

namespace pleinair::compositor {
namespace {

// The sky's logarithmic scale. The range reaches from a black sky to one that leaves hardly a sun.
constexpr int kScales = 56;
constexpr double kFirstScale = -2.0, kScaleStep = 0.1;

/// A kind of place: hardly any unmodelled shade, shade by solid things, or by leaves. In each kind,
/// the shade of one surface is any of some mixes.
struct Kind {
  std::size_t first, count;  // Range in kShades.
  double prior;
  double on_marker;  // Expected share of shade.
};
constexpr std::array<UnmodelledShade, 22> kShades{
    {{0.01},          {0.02},          {0.1},           {0.4},           {0.7},
     {0.95},          {0.1, true, 0},  {0.1, true, 1},  {0.1, true, 2},  {0.1, true, 3},
     {0.35, true, 0}, {0.35, true, 1}, {0.35, true, 2}, {0.35, true, 3}, {0.7, true, 0},
     {0.7, true, 1},  {0.7, true, 2},  {0.7, true, 3},  {0.95, true, 0}, {0.95, true, 1},
     {0.95, true, 2}, {0.95, true, 3}}};
constexpr std::array<Kind, 3> kKinds{{{0, 1, 0.6, 0.01}, {1, 5, 0.2, 0.3}, {6, 16, 0.2, 0.5}}};
// Under a sun from elsewhere, and under clouds.
constexpr std::array kOtherShade{UnmodelledShade{0.4}}, kNoShade{UnmodelledShade{}};

// One standard deviation of the modelled light on a plane, logarithmic.
constexpr double kPlaneError = 0.15, kOtherPlaneError = 0.6;
// The same of the sky before a plane that is not level: the model's sky differs from the true one
// by direction. Integrated by three points (Gauss and Hermite: 0, ±√3 σ with weights 2/3, 1/6).
constexpr double kSkyError = 0.2, kLevelCosine = 0.9;
// Probability that something stains the marker.
constexpr double kStained = 0.02;
// Common to all edges, logarithmic: shape of the sky, described colors.
constexpr double kCommonError = 0.07;
// The same of the depth of unmodelled shade: what its caster hides of the sky. Counts by the
// probability that there is such shade.
constexpr double kCasterError = 0.12;
constexpr double kClearStep = 0.25;  // Contrast of edges that count.

/// Evidence for one kind of place at one sky radiance scale.
struct KindEvidence {
  double log = 0.0;           // Evidence and prior.
  double level = 0.0;         // Expected error of the exposure scale.
  double marker_shade = 0.0;  // Expected MarkerExposure::LogShade.
};
using ByKind = std::array<KindEvidence, kKinds.size()>;

double LogAdd(double a, double b) {
  const double top = std::max(a, b);
  return top + std::log(std::exp(a - top) + std::exp(b - top));
}

class Fit {
 public:
  Fit(const std::vector<LightCell>& cells, const LightFitInput& input)
      : cells_(cells), input_(input) {
    for (const LightCell& cell : cells) surfaces_[cell.surface][cell.plane].push_back(&cell);
    for (int i = 0; i < kScales; ++i) scales_[i] = kFirstScale + kScaleStep * i;
  }

  LightPosterior Solve() const;

 private:
  using Planes = std::map<int, std::vector<const LightCell*>>;

  /// Level evidence of the planes of a surface, per mix.
  template <typename Predict>
  std::vector<std::vector<LevelFunction>> OfPlanes(const Planes& planes,
                                                   std::span<const UnmodelledShade> shades,
                                                   const Predict& predict) const;
  /// Logarithmic likelihood of the exposure scale's error by one surface, per mix.
  template <typename Predict>
  std::vector<LevelFunction> OfSurface(int surface, std::span<const UnmodelledShade> shades,
                                       double plane_error, const Predict& predict) const;
  /// The same by all surfaces, under one mix.
  template <typename Predict>
  LevelFunction OfAll(std::span<const UnmodelledShade> shade, double plane_error,
                      const Predict& predict) const;
  MarkerExposure Exposure(double log_scale, const Kind& kind) const;
  ByKind SunEvidence(double log_scale) const;
  double CloudEvidence() const;
  double OtherEvidence() const;
  /// What a scale and kind of place make of the cells.
  void Explain(double log_scale, const Kind& kind, double e, LightPosterior* found) const;

  double SkyErrorOf(const LightCell& cell, int i) const {
    constexpr std::array kPoints{0.0, -1.7320508, 1.7320508};
    return Dot(cell.normal, input_.up) > kLevelCosine ? 0.0 : kSkyError * kPoints[i];
  }
  auto InSun(double log_scale) const {
    return [this, log_scale](const LightCell& cell, int i) {
      return PredictInSun(cell, log_scale, SkyErrorOf(cell, i));
    };
  }

  const std::vector<LightCell>& cells_;
  const LightFitInput& input_;
  std::map<int, Planes> surfaces_;
  std::array<double, kScales> scales_;
};

template <typename Predict>
std::vector<std::vector<LevelFunction>> Fit::OfPlanes(const Planes& planes,
                                                      std::span<const UnmodelledShade> shades,
                                                      const Predict& predict) const {
  constexpr std::array kWeights{2.0 / 3, 1.0 / 6, 1.0 / 6};
  std::vector<std::vector<LevelFunction>> by_mix(shades.size());
  for (const auto& [plane, members] : planes) {
    std::vector<CellPrediction> predictions(members.size());
    const bool level = SkyErrorOf(*members.front(), 1) == 0.0;
    std::vector<LevelFunction> sum(shades.size());
    for (int i = 0; i < (level ? 1 : 3); ++i) {
      for (std::size_t k = 0; k < members.size(); ++k) predictions[k] = predict(*members[k], i);
      const auto evidence = LevelEvidence::OfPlane(members, predictions, shades);
      const double weight = level ? 0.0 : std::log(kWeights[i]);
      for (std::size_t m = 0; m < shades.size(); ++m) {
        for (int u = 0; u < LevelGrid::kCount; ++u) {
          const double value = evidence[m][u] + weight;
          sum[m][u] = i == 0 ? value : LogAdd(sum[m][u], value);
        }
      }
    }
    for (std::size_t m = 0; m < shades.size(); ++m) by_mix[m].push_back(sum[m]);
  }
  return by_mix;
}

template <typename Predict>
std::vector<LevelFunction> Fit::OfSurface(int surface, std::span<const UnmodelledShade> shades,
                                          double plane_error, const Predict& predict) const {
  const auto evidence = OfPlanes(surfaces_.at(surface), shades, predict);
  std::vector<LevelFunction> by_mix(shades.size());
  for (std::size_t m = 0; m < shades.size(); ++m) {
    if (surface < 0) {
      // The marker's brightness is the prior of the exposure scale; only its edges count here.
      by_mix[m].fill(LogSum(evidence[m].front()));
    } else {
      by_mix[m] = LevelEvidence::OfSurface(evidence[m], plane_error);
    }
  }
  return by_mix;
}

template <typename Predict>
LevelFunction Fit::OfAll(std::span<const UnmodelledShade> shade, double plane_error,
                         const Predict& predict) const {
  LevelFunction sum{};
  for (const auto& [surface, planes] : surfaces_) {
    const LevelFunction evidence = OfSurface(surface, shade, plane_error, predict).front();
    for (int e = 0; e < LevelGrid::kCount; ++e) sum[e] += evidence[e];
  }
  return sum;
}

MarkerExposure Fit::Exposure(double log_scale, const Kind& kind) const {
  const CellLight& from = input_.marker.from;
  return {input_.marker, from.sky * std::exp(log_scale) + from.reflected, input_.marker.sun,
          kind.on_marker};
}

ByKind Fit::SunEvidence(double log_scale) const {
  std::array<LevelFunction, kKinds.size()> sums;
  for (std::size_t k = 0; k < kKinds.size(); ++k)
    sums[k] = Exposure(log_scale, kKinds[k]).LogPrior();
  for (const auto& [surface, planes] : surfaces_) {
    const auto by_mix = OfSurface(surface, kShades, kPlaneError, InSun(log_scale));
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      const auto& [first, count, prior, on_marker] = kKinds[k];
      for (int e = 0; e < LevelGrid::kCount; ++e) {
        double any = by_mix[first][e];
        for (std::size_t m = first + 1; m < first + count; ++m) any = LogAdd(any, by_mix[m][e]);
        sums[k][e] += any - std::log(static_cast<double>(count));
      }
    }
  }
  ByKind found;
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    const double log = LogSum(sums[k]);
    found[k].log = log + std::log(kKinds[k].prior);
    const MarkerExposure exposure = Exposure(log_scale, kKinds[k]);
    for (int e = 0; e < LevelGrid::kCount; ++e) {
      const double p = std::exp(sums[k][e] - log) * LevelGrid::kStep;
      found[k].level += p * LevelGrid::At(e);
      found[k].marker_shade += p * exposure.LogShade(LevelGrid::At(e));
    }
  }
  return found;
}

double Fit::OtherEvidence() const {
  LevelFunction evidence = OfAll(kOtherShade, kOtherPlaneError, [&](const LightCell& cell, int) {
    return PredictInOtherSun(cell, input_.sun);
  });
  return LogSum(evidence) - std::log(LevelGrid::kCount * LevelGrid::kStep);
}

double Fit::CloudEvidence() const {
  const auto under_clouds = [](const LightCell& cell, int) { return PredictUnderClouds(cell); };
  LevelFunction evidence = OfAll(kNoShade, kPlaneError, under_clouds);
  const LevelFunction exposure =
      MarkerExposure(input_.marker, input_.marker.from.overcast, {}, 0.0).LogPrior();
  for (int e = 0; e < LevelGrid::kCount; ++e) evidence[e] += exposure[e];
  double log = LogSum(evidence);
  if (surfaces_.contains(-1)) {
    // A stained marker shows steps like those of shadows.
    const double clean = OfSurface(-1, kNoShade, kPlaneError, under_clouds).front().front();
    const double stained =
        OfSurface(-1, kOtherShade, kPlaneError,
                  [&](const LightCell& cell, int) { return PredictInOtherSun(cell, input_.sun); })
            .front()
            .front();
    log += LogAdd(clean, std::log(kStained) + stained) - clean;
  }
  return log;
}

void Fit::Explain(double log_scale, const Kind& kind, double e, LightPosterior* found) const {
  const std::span<const UnmodelledShade> shades(&kShades[kind.first], kind.count);
  const int at_e = static_cast<int>(std::lround((e - LevelGrid::kFirst) / LevelGrid::kStep));
  found->shade.assign(cells_.size(), {});
  std::vector<WeightedContrast> contrasts;
  int sunny = 0;
  for (const auto& [surface, planes] : surfaces_) {
    const auto by_mix = OfSurface(surface, shades, kPlaneError, InSun(log_scale));
    std::size_t mix = 0;
    for (std::size_t m = 1; m < by_mix.size(); ++m)
      mix = by_mix[m][at_e] > by_mix[mix][at_e] ? m : mix;
    const auto evidence = OfPlanes(planes, shades.subspan(mix, 1), InSun(log_scale)).front();
    std::size_t plane = 0;
    for (const auto& [number, members] : planes) {
      const double u = LevelEvidence::BestLevel(evidence, plane++, e, kPlaneError);
      for (const LightCell* cell : members) {
        if (!cell->sunny) continue;
        const CellPrediction at = PredictInSun(*cell, log_scale, 0.0);
        const auto states = LevelEvidence::StatesOf(*cell, at, shades[mix], u);
        const double open = states[kOpen] + states[kNearlyOpen];
        const double shaded = 1 - open - states[kStray];
        found->shade[static_cast<std::size_t>(cell - cells_.data())] = {
            shaded, at.open + u, at.open - at.dark, shades[mix]};
        if (cell->shaded) {
          if (at.open - at.dark < kClearStep) continue;
          ++found->counted.edges;
          found->counted.edges_agreeing += open > 0.5 ? 1 : 0;
          found->counted.contrast += open;
          contrasts.push_back({cell, states[kOpen]});
          continue;
        }
        if (cell->step) contrasts.push_back({cell, states[kDivided]});
        if (surface < 0) {
          found->counted.marker_steps += cell->step && shaded > 0.5 ? 1 : 0;
        } else {
          ++sunny;
          found->counted.shaded_places += shaded > 0.5 ? 1 : 0;
        }
      }
    }
  }
  if (found->counted.edges > 0) found->counted.contrast /= found->counted.edges;
  if (sunny > 0) found->shaded = static_cast<double>(found->counted.shaded_places) / sunny;
  const LogRgb color = FitSkyColor(contrasts, log_scale);
  for (std::size_t c = 0; c < 3; ++c) found->log_sky[c] = log_scale + color[c];
}

LightPosterior Fit::Solve() const {
  LightPosterior found;
  const LightPrior& prior = input_.prior;
  std::vector<ByKind> logs(scales_.size());
  ParallelFor(scales_.size(), 0, [&](std::size_t i) {
    logs[i] = SunEvidence(scales_[i]);
    const double z = scales_[i] / prior.log_sky_error;
    for (KindEvidence& kind : logs[i])
      kind.log += -0.5 * z * z -
                  std::log(prior.log_sky_error * std::sqrt(2 * std::numbers::pi) / kScaleStep);
  });
  double top = logs.front().front().log;
  for (const ByKind& kinds : logs) {
    for (const KindEvidence& kind : kinds) top = std::max(top, kind.log);
  }
  double total = 0.0, first = 0.0, second = 0.0, level = 0.0;
  std::array<double, kKinds.size()> by_kind{};
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      const double p = std::exp(logs[i][k].log - top);
      total += p;
      first += p * scales_[i];
      second += p * scales_[i] * scales_[i];
      by_kind[k] += p;
      level += p * logs[i][k].level;
      found.log_marker_shade += p * logs[i][k].marker_shade;
    }
  }
  const double mean = first / total;
  found.log_marker_shade /= total;
  found.log_sky_error = std::hypot(std::sqrt(std::max(0.0, second / total - mean * mean)),
                                   kCommonError, kCasterError * (1 - by_kind[0] / total));
  const double sun = top + std::log(total) + std::log(prior.sun);
  const double clouds = CloudEvidence() + std::log(prior.clouds);
  const double elsewhere = OtherEvidence() + std::log(prior.elsewhere);
  const double all = LogAdd(sun, LogAdd(clouds, elsewhere));
  found.sun = std::exp(sun - all);
  found.clouds = std::exp(clouds - all);
  found.elsewhere = std::exp(elsewhere - all);
  const auto kind = std::max_element(by_kind.begin(), by_kind.end()) - by_kind.begin();
  Explain(mean, kKinds[static_cast<std::size_t>(kind)], level / total, &found);
  return found;
}

}  // namespace

LightPosterior FitLight(const std::vector<LightCell>& cells, const LightFitInput& input) {
  if (Luminance(input.marker.predicted) > 0.0 || cells.empty()) return Fit(cells, input).Solve();
  // Without a marker the unit of the samples is unknown: most cells get the level of the described
  // colors in the open.
  std::vector<double> offsets;
  offsets.reserve(cells.size());
  for (const LightCell& cell : cells) {
    offsets.push_back(LevelOf(cell) - PredictInSun(cell, 0.0, 0.0).open);
  }
  const double offset = Median(offsets);
  std::vector<LightCell> shifted = cells;
  for (LightCell& cell : shifted) {
    for (auto* part : {&cell.sunny, &cell.shaded}) {
      for (std::size_t c = 0; *part && c < 3; ++c) (*part)->log_rgb[c] -= offset;
    }
    if (cell.step) cell.step->bright -= offset;
  }
  LightPosterior found = Fit(shifted, input).Solve();
  for (CellShade& shade : found.shade) shade.level += offset;
  return found;
}

}  // namespace pleinair::compositor
