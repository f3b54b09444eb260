#include "compositor/photometry/estimate/light_posterior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "compositor/photometry/estimate/cell_model.h"
#include "compositor/photometry/estimate/level_evidence.h"
#include "compositor/photometry/estimate/shade_field.h"
#include "compositor/photometry/estimate/shaded_levels.h"
#include "compositor/photometry/estimate/sky_color.h"

namespace pleinair::compositor {
namespace {

// The sky's logarithmic scale. The range reaches from a black sky to one that leaves hardly a sun.
constexpr int kScales = 56;
constexpr double kFirstScale = -2.0, kScaleStep = 0.1;

/// A kind of place: hardly any unmodelled shade, shade by solid things, or by leaves. In each kind,
/// the shade of one place is any of some mixes.
struct Kind {
  std::size_t first, count;  // Range in kShades.
  double prior;
  double taken;  // Share of the sky that the casters hide.

  std::span<const UnmodelledShade> mixes() const;
};
constexpr std::array<UnmodelledShade, 22> kShades{
    {{0.01},          {0.02},          {0.1},           {0.4},           {0.7},
     {0.95},          {0.1, true, 0},  {0.1, true, 1},  {0.1, true, 2},  {0.1, true, 3},
     {0.35, true, 0}, {0.35, true, 1}, {0.35, true, 2}, {0.35, true, 3}, {0.7, true, 0},
     {0.7, true, 1},  {0.7, true, 2},  {0.7, true, 3},  {0.95, true, 0}, {0.95, true, 1},
     {0.95, true, 2}, {0.95, true, 3}}};
constexpr std::array<Kind, 3> kKinds{
    {{0, 1, 0.6, 0.0}, {1, 5, 0.2, kTakenBySolid}, {6, 16, 0.2, kTakenByCrown}}};
std::span<const UnmodelledShade> Kind::mixes() const {
  return std::span(kShades).subspan(first, count);
}
// Under a sun from elsewhere, and under clouds.
constexpr std::array kOtherShade{UnmodelledShade{0.4}}, kNoShade{UnmodelledShade{}};

// One standard deviation of the modelled light on a plane, logarithmic.
constexpr double kPlaneError = 0.15, kOtherPlaneError = 0.6;
// The same of the sky before a plane that is not level: the model's sky differs from the true one
// by direction. Integrated by three points (Gauss and Hermite: 0, ±√3 σ with weights 2/3, 1/6).
constexpr double kSkyError = 0.2;
constexpr std::array<ShadedLevels::SkyError, 3> kSkyErrors{
    {{0.0, 2.0 / 3}, {-1.7320508 * kSkyError, 1.0 / 6}, {1.7320508 * kSkyError, 1.0 / 6}}};
constexpr std::array kNoSkyError{ShadedLevels::SkyError{}};
// Errors of the exposure scale are tried in this step of the grid, unless their probability without
// neighbours is below the largest by this logarithm.
constexpr int kExposureStep = 4;
constexpr double kNegligible = 12.0;
// The same of the sky's scales within a kind of place. Neighbours change more there.
constexpr double kUnlikely = 20.0;
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
      : cells_(cells), input_(input), field_(cells, input.to_sun) {
    for (int i = 0; i < kScales; ++i) scales_[i] = kFirstScale + kScaleStep * i;
  }

  LightPosterior Solve() const;

 private:
  MarkerExposure Exposure(double log_scale, const Kind& kind, double shaded) const;
  ShadedLevels InSun(double log_scale, const Kind& kind) const;
  /// Adds the marker's prior of the exposure scale, if half of its place is shaded.
  LevelFunction WithMarker(double log_scale, const Kind& kind, LevelFunction uncoupled) const;
  /// `uncoupled`: ShadedLevels::Uncoupled() of this scale and kind.
  KindEvidence SunEvidence(double log_scale, const Kind& kind,
                           const LevelFunction& uncoupled) const;
  /// The evidence of all scales and kinds. Scales that are far from likely have none.
  std::vector<ByKind> SunEvidence() const;
  double CloudEvidence() const;
  double OtherEvidence() const;
  /// What a scale and kind of place make of the cells.
  void Explain(double log_scale, const Kind& kind, double e, LightPosterior* found) const;

  const std::vector<LightCell>& cells_;
  const LightFitInput& input_;
  ShadeField field_;
  std::array<double, kScales> scales_;
};

MarkerExposure Fit::Exposure(double log_scale, const Kind& kind, double shaded) const {
  const CellLight& from = input_.marker.from;
  return {input_.marker, from.sky * std::exp(log_scale) + from.reflected, input_.marker.sun, shaded,
          kind.taken};
}

ShadedLevels Fit::InSun(double log_scale, const Kind& kind) const {
  return {cells_,
          &field_,
          input_.up,
          kind.mixes(),
          kSkyErrors,
          kPlaneError,
          [log_scale](const LightCell& cell, double log_sky_error) {
            return PredictInSun(cell, log_scale, log_sky_error);
          }};
}

LevelFunction Fit::WithMarker(double log_scale, const Kind& kind, LevelFunction uncoupled) const {
  const MarkerExposure anywhere = Exposure(log_scale, kind, 0.5);
  for (int i = 0; i < LevelGrid::kCount; ++i) uncoupled[i] += anywhere.LogPrior(LevelGrid::At(i));
  return uncoupled;
}

KindEvidence Fit::SunEvidence(double log_scale, const Kind& kind,
                              const LevelFunction& uncoupled) const {
  ShadedLevels levels = InSun(log_scale, kind);
  const LevelFunction rough = WithMarker(log_scale, kind, uncoupled);
  const double likely = *std::max_element(rough.begin(), rough.end()) - kNegligible;
  std::vector<double> errors, logs, shades;
  for (int i = LevelGrid::kCount - 1; i >= 0; i -= kExposureStep) {
    const int before = std::max(0, i - kExposureStep + 1);
    if (*std::max_element(&rough[before], &rough[i] + 1) < likely) continue;
    const double e = LevelGrid::At(i);
    // Neighbours change nothing where there is one mix.
    const bool is_coupled = kind.count > 1;
    if (is_coupled && errors.empty()) levels.At(e);
    const double log = is_coupled ? levels.At(e) : uncoupled[i];
    const MarkerExposure exposure = Exposure(log_scale, kind, levels.ShareOnMarker());
    errors.push_back(e);
    logs.push_back(log + exposure.LogPrior(e));
    shades.push_back(exposure.LogShade(e));
  }
  const double top = *std::max_element(logs.begin(), logs.end());
  KindEvidence found;
  double sum = 0.0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const double p = std::exp(logs[i] - top);
    sum += p;
    found.level += p * errors[i];
    found.marker_shade += p * shades[i];
  }
  found.log = top + std::log(sum * kExposureStep * LevelGrid::kStep) + std::log(kind.prior);
  found.level /= sum;
  found.marker_shade /= sum;
  return found;
}

std::vector<ByKind> Fit::SunEvidence() const {
  const double doubt = input_.prior.log_sky_error;
  const auto log_prior = [&](double log_scale) {
    const double z = log_scale / doubt;
    return -0.5 * z * z - std::log(doubt * std::sqrt(2 * std::numbers::pi) / kScaleStep);
  };
  std::vector<std::array<LevelFunction, kKinds.size()>> uncoupled(scales_.size());
  std::vector<std::array<double, kKinds.size()>> rough(scales_.size());
  ParallelFor(scales_.size(), 0, [&](std::size_t i) {
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      uncoupled[i][k] = InSun(scales_[i], kKinds[k]).Uncoupled();
      rough[i][k] =
          LogSum(WithMarker(scales_[i], kKinds[k], uncoupled[i][k])) + log_prior(scales_[i]);
    }
  });
  std::array<double, kKinds.size()> likely;
  likely.fill(-std::numeric_limits<double>::infinity());
  for (const auto& kinds : rough) {
    for (std::size_t k = 0; k < kKinds.size(); ++k)
      likely[k] = std::max(likely[k], kinds[k] - kUnlikely);
  }
  std::vector<ByKind> found(scales_.size());
  ParallelFor(scales_.size(), 0, [&](std::size_t i) {
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      if (rough[i][k] < likely[k]) {
        found[i][k].log = -std::numeric_limits<double>::infinity();
        continue;
      }
      found[i][k] = SunEvidence(scales_[i], kKinds[k], uncoupled[i][k]);
      found[i][k].log += log_prior(scales_[i]);
    }
  });
  return found;
}

double Fit::OtherEvidence() const {
  ShadedLevels levels(
      cells_, nullptr, input_.up, kOtherShade, kNoSkyError, kOtherPlaneError,
      [this](const LightCell& cell, double) { return PredictInOtherSun(cell, input_.sun); });
  return LogSum(levels.Uncoupled()) - std::log(LevelGrid::kCount * LevelGrid::kStep);
}

double Fit::CloudEvidence() const {
  const auto under_clouds = [](const LightCell& cell, double) { return PredictUnderClouds(cell); };
  const ShadedLevels levels(cells_, nullptr, input_.up, kNoShade, kNoSkyError, kPlaneError,
                            under_clouds);
  const MarkerExposure exposure(input_.marker, input_.marker.from.overcast, {}, 0.0, 0.0);
  LevelFunction evidence = levels.Uncoupled();
  for (int i = 0; i < LevelGrid::kCount; ++i) evidence[i] += exposure.LogPrior(LevelGrid::At(i));
  std::vector<LightCell> of_marker;
  for (const LightCell& cell : cells_) {
    if (cell.surface < 0) of_marker.push_back(cell);
  }
  if (of_marker.empty()) return LogSum(evidence);
  // A stained marker shows steps like those of shadows.
  const auto marker_evidence = [&](std::span<const UnmodelledShade> shade,
                                   const ShadedLevels::Predict& predict) {
    return ShadedLevels(of_marker, nullptr, input_.up, shade, kNoSkyError, kPlaneError, predict)
        .At(0.0);
  };
  const double clean = marker_evidence(kNoShade, under_clouds);
  const double stained = marker_evidence(kOtherShade, [this](const LightCell& cell, double) {
    return PredictInOtherSun(cell, input_.sun);
  });
  return LogSum(evidence) + LogAdd(clean, std::log(kStained) + stained) - clean;
}

void Fit::Explain(double log_scale, const Kind& kind, double e, LightPosterior* found) const {
  ShadedLevels levels = InSun(log_scale, kind);
  levels.At(e);
  levels.At(e);
  found->shade.assign(cells_.size(), {});
  std::vector<WeightedContrast> contrasts;
  int sunny = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const LightCell& cell = cells_[i];
    if (!cell.sunny) continue;
    const double u = levels.LevelErrorOf(i);
    const CellPrediction at = PredictInSun(cell, log_scale, 0.0);
    const auto around = levels.StatePriorOf(i, at);
    const auto states = LevelEvidence::StatesOf(cell, at, around, u);
    const double open = states[kOpen] + states[kGap] + states[kNearlyOpen];
    const double shaded = 1 - open - states[kStray];
    found->shade[i] = {shaded, at.open + u, at.open - at.dark, around};
    if (cell.shaded) {
      if (at.open - at.dark < kClearStep) continue;
      ++found->counted.edges;
      found->counted.edges_agreeing += open > 0.5 ? 1 : 0;
      found->counted.contrast += open;
      contrasts.push_back({&cell, states[kOpen] + states[kGap]});
      continue;
    }
    if (cell.step) contrasts.push_back({&cell, states[kDivided]});
    if (cell.surface < 0) {
      found->counted.marker_steps += cell.step && shaded > 0.5 ? 1 : 0;
    } else {
      ++sunny;
      found->counted.shaded_places += shaded > 0.5 ? 1 : 0;
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
  const std::vector<ByKind> logs = SunEvidence();
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
