#include "compositor/photometry/estimate/cell_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::compositor {
namespace {

// Standard deviations of a logarithm of light. kPatternError: a surface's pattern between the two
// sides of an edge. kModelError: the modelled contrast. Its causes are small things without a
// phantom, and described colors that reflect on both sides.
constexpr double kPatternError = 0.05, kModelError = 0.10;
// Red and blue against green, at an edge; and at a step, where leaves add their own color.
constexpr double kColorError = 0.10, kStepColorError = 0.15;
// Steps that a surface's pattern makes: probability, mean height, and error of their color.
constexpr double kPatternStep = 0.15, kPatternHeight = 0.4, kPatternColor = 0.10;
// Probability that a shadow's end within a cell shows as a step, and the error of its depth.
constexpr double kStepSeen = 0.7;
constexpr double kStepError = 0.15;
// Anything may be seen in strays: logarithmic width of their contrasts and of their colors.
constexpr double kStrayWidth = 0.7, kStrayColor = 0.3, kStrayShare = 0.02;
// States of cells in unmodelled shade: even, partial, divided, mottled; by solid things and by
// leaves.
constexpr std::array kSolid{0.55, 0.10, 0.25, 0.10}, kLeaves{0.30, 0.40, 0.05, 0.25};
// Beneath leaves, the share of what they do not shade that has all of the sun.
constexpr double kOpenBetweenLeaves = 0.6;
// Share of the reflected sunlight that goes with the sun beneath a crown. A guess.
constexpr double kNotReflected = 0.5;
// For places that the phantoms shade by themselves. kMaxTaken: max. share of the sky that a crown
// takes. kMinReflected: min. share of the reflected sunlight that it leaves.
constexpr double kMaxTaken = 0.6, kMinReflected = 0.2;
// For a sun elsewhere. kElsewhere: share of the phantoms' edges where its light differs on the two
// sides. kOtherCosine: its cosine on a surface.
constexpr double kElsewhere = 0.4, kOtherCosine = 0.5;

constexpr LinearRgb kModelSky{1, 1, 1};

double Normal(double value, double sigma) {
  const double z = value / sigma;
  return std::exp(-0.5 * z * z) / (sigma * std::sqrt(2 * std::numbers::pi));
}

double NormalShare(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Density of a value that lies anywhere between `low` and `high`, measured with the error `sigma`.
double Between(double value, double low, double high, double sigma) {
  if (high < low) std::swap(low, high);
  if (high - low < 0.1 * sigma) return Normal(value - low, sigma);
  return (NormalShare((value - low) / sigma) - NormalShare((value - high) / sigma)) / (high - low);
}

/// Light in unmodelled shade.
LinearRgb SolidShade(const CellPart& part, LinearRgb sky_scale) {
  return part.light.sky * sky_scale * (1 - kTakenBySolid) + part.light.reflected;
}
LinearRgb CrownShade(const CellPart& part, LinearRgb sky_scale) {
  return part.light.sky * sky_scale * (1 - kTakenByCrown) +
         part.light.reflected * (1 - kNotReflected);
}

LinearRgb BeneathCrown(const CellPart& part, LinearRgb sky_scale) {
  return part.light.sky * sky_scale * (1 - kMaxTaken) + part.light.reflected * kMinReflected;
}

LogRgb Log(LinearRgb light) { return {std::log(light.r), std::log(light.g), std::log(light.b)}; }

/// Density of the colors of a contrast, red and blue against green.
double ColorDensity(const LogRgb& seen, const LogRgb& predicted, double sigma) {
  const auto off = [&](std::size_t c) { return seen[c] - seen[1] - (predicted[c] - predicted[1]); };
  return Normal(off(0), sigma) * Normal(off(2), sigma);
}

double StrayDensity(const LogRgb& contrast) {
  return Normal(Brightness(contrast), kStrayWidth) * ColorDensity(contrast, {}, kStrayColor);
}

/// Contrast of the two parts of a cell.
LogRgb SeenContrast(const LightCell& cell) {
  LogRgb contrast;
  for (std::size_t c = 0; c < 3; ++c)
    contrast[c] = cell.sunny->log_rgb[c] - cell.shaded->log_rgb[c];
  return contrast;
}

double PatternStepDensity(const LogRgb& contrast) {
  return std::exp(-Brightness(contrast) / kPatternHeight) / kPatternHeight *
         ColorDensity(contrast, {}, kPatternColor);
}

/// Contrast whose brightness is `brightness`, with the color that shadows have under the model's
/// own sky: on the way from `none` to `full`. So a color tells shadows from patterns, but not the
/// sky's strength: the sky's true color differs from the model's.
LogRgb ShadowOf(double brightness, const LogRgb& none, const LogRgb& full) {
  const double depth = Brightness(full) - Brightness(none);
  const double share =
      depth > 0.0 ? std::clamp((brightness - Brightness(none)) / depth, 0.0, 2.0) : 0.0;
  LogRgb contrast;
  for (std::size_t c = 0; c < 3; ++c) contrast[c] = none[c] + share * (full[c] - none[c]);
  return contrast;
}

/// Sets the densities of a cell with one part. `depth` is that of the full shadow, `model` the same
/// under the model's own sky.
void SetStepDensities(const LightCell& cell, double depth, const LogRgb& model,
                      CellPrediction* prediction) {
  auto& density = prediction->density;
  if (!cell.step) {
    prediction->density.fill(1 - kPatternStep);
    if (depth > 0.0) density[kDivided] = density[kMottled] = 1 - kStepSeen;
    return;
  }
  const LogRgb& contrast = cell.step->contrast;
  prediction->density.fill(kPatternStep * PatternStepDensity(contrast));
  if (depth <= 0.0) return;
  const double seen = Brightness(contrast);
  const double color = ColorDensity(contrast, ShadowOf(seen, {}, model), kStepColorError);
  density[kDivided] = kStepSeen * Normal(seen - depth, kStepError) * color;
  density[kMottled] = kStepSeen * Between(seen, 0.0, depth, kStepError) * color;
  density[kStray] = std::max(density[kOpen], kPatternStep * StrayDensity(contrast));
}

/// Depth of unmodelled shade on the sunny part, under the model's own sky.
LogRgb ModelDepth(const LightCell& cell) {
  return ContrastOf(OpenLight(cell, *cell.sunny, kModelSky), SolidShade(*cell.sunny, kModelSky));
}

/// Brightness of the described surface in this light: logarithm of cd/m².
double LevelIn(const LightCell& cell, LinearRgb light) {
  return MeanLog(light * cell.albedo * (1 / std::numbers::pi));
}

void SetOneLevel(double level, CellPrediction* prediction) {
  prediction->open = prediction->dark = prediction->gap = level;
  prediction->crown.fill(level);
}

/// `dark`, `crown`: the light in shade without any sun; `sun`: all of the sun.
void SetLevels(const LightCell& cell, LinearRgb open, LinearRgb dark, LinearRgb crown,
               LinearRgb sun, CellPrediction* prediction) {
  prediction->open = LevelIn(cell, open);
  prediction->dark = LevelIn(cell, dark);
  for (std::size_t i = 0; i < kBands.size(); ++i)
    prediction->crown[i] = LevelIn(cell, crown + sun * kBands[i]);
  prediction->gap = LevelIn(cell, crown + sun);
}

}  // namespace

LinearRgb OpenLight(const LightCell& cell, const CellPart& part, LinearRgb sky_scale) {
  return DarkLight(part, sky_scale) + cell.sun;
}

LinearRgb DarkLight(const CellPart& part, LinearRgb sky_scale) {
  return part.light.sky * sky_scale + part.light.reflected;
}

LogRgb ContrastOf(LinearRgb bright, LinearRgb dark) {
  const LogRgb of_bright = Log(bright), of_dark = Log(dark);
  return {of_bright[0] - of_dark[0], of_bright[1] - of_dark[1], of_bright[2] - of_dark[2]};
}

double ContrastError(const LightCell& cell) {
  return std::sqrt(cell.sunny->variance + cell.shaded->variance + kPatternError * kPatternError +
                   kModelError * kModelError);
}

CellPrediction PredictInSun(const LightCell& cell, double log_sky_scale, double log_sky_error) {
  const LinearRgb scale = LinearRgb{1, 1, 1} * std::exp(log_sky_scale + log_sky_error);
  CellPrediction prediction;
  if (!cell.sunny) {
    const LinearRgb light = DarkLight(*cell.shaded, scale);
    SetLevels(cell, light, light, BeneathCrown(*cell.shaded, scale), {}, &prediction);
    SetStepDensities(cell, 0.0, {}, &prediction);
    return prediction;
  }
  prediction.in_sun = true;
  const LinearRgb open = OpenLight(cell, *cell.sunny, scale), dark = SolidShade(*cell.sunny, scale);
  const LinearRgb crown = CrownShade(*cell.sunny, scale);
  SetLevels(cell, open, dark, crown, cell.sun, &prediction);
  if (!cell.shaded) {
    SetStepDensities(cell, prediction.open - prediction.dark, ModelDepth(cell), &prediction);
    return prediction;
  }
  const LinearRgb shaded = DarkLight(*cell.shaded, scale);
  const LogRgb seen = SeenContrast(cell);
  const double full = Brightness(ContrastOf(open, shaded));
  const double none = Brightness(ContrastOf(dark, shaded));
  const double sigma = ContrastError(cell), brightness = Brightness(seen);
  const LinearRgb shaded_by_model = DarkLight(*cell.shaded, kModelSky);
  const LogRgb no_shadow = ContrastOf(DarkLight(*cell.sunny, kModelSky), shaded_by_model);
  const LogRgb shadow = ShadowOf(
      brightness, no_shadow, ContrastOf(OpenLight(cell, *cell.sunny, kModelSky), shaded_by_model));
  const double color = ColorDensity(seen, shadow, kColorError);
  const double between = Between(brightness, none, full, sigma) * color;
  prediction.density = {Normal(brightness - full, sigma) * color, between, between, between,
                        StrayDensity(seen)};
  prediction.density[kGap] = prediction.density[kOpen];
  prediction.density[kDark] =
      Normal(brightness - none, sigma) * ColorDensity(seen, no_shadow, kColorError);
  double low = Brightness(ContrastOf(crown, shaded));
  prediction.density[kFiltered] = Between(brightness, low, full, sigma) * color;
  for (std::size_t i = 0; i < kBands.size(); ++i) {
    const bool last = i + 1 == kBands.size();
    const double high =
        last ? full : Brightness(ContrastOf(crown + cell.sun * kBands[i + 1], shaded));
    prediction.density[kBand + i] = Between(brightness, low, high, sigma) * color;
    low = high;
  }
  return prediction;
}

CellPrediction PredictAtLevel(const LightCell& cell, double open, const LogRgb& log_sky_scale) {
  const LinearRgb scale{std::exp(log_sky_scale[0]), std::exp(log_sky_scale[1]),
                        std::exp(log_sky_scale[2])};
  const LogRgb depth =
      ContrastOf(OpenLight(cell, *cell.sunny, scale), SolidShade(*cell.sunny, scale));
  CellPrediction prediction;
  prediction.in_sun = true;
  SetLevels(cell, OpenLight(cell, *cell.sunny, scale), SolidShade(*cell.sunny, scale),
            CrownShade(*cell.sunny, scale), cell.sun, &prediction);
  for (double& level : prediction.crown) level += open - prediction.open;
  prediction.dark += open - prediction.open;
  prediction.gap += open - prediction.open;
  prediction.open = open;
  SetStepDensities(cell, Brightness(depth), ModelDepth(cell), &prediction);
  return prediction;
}

CellPrediction PredictUnderClouds(const LightCell& cell) {
  const CellPart& part = cell.sunny ? *cell.sunny : *cell.shaded;
  CellPrediction prediction;
  SetOneLevel(LevelIn(cell, part.light.overcast), &prediction);
  if (!cell.sunny || !cell.shaded) {
    SetStepDensities(cell, 0.0, {}, &prediction);
    return prediction;
  }
  const LogRgb seen = SeenContrast(cell);
  const LogRgb none = ContrastOf(cell.sunny->light.overcast, cell.shaded->light.overcast);
  prediction.density.fill(Normal(Brightness(seen) - Brightness(none), ContrastError(cell)) *
                          ColorDensity(seen, none, kColorError));
  prediction.density[kStray] = StrayDensity(seen);
  return prediction;
}

CellPrediction PredictInOtherSun(const LightCell& cell, LinearRgb sun) {
  const CellPart& part = cell.sunny ? *cell.sunny : *cell.shaded;
  const LinearRgb dark = DarkLight(part, {1, 1, 1});
  const LinearRgb open = dark + sun * kOtherCosine;
  CellPrediction prediction;
  prediction.in_sun = true;
  SetLevels(cell, open, dark, dark, sun * kOtherCosine, &prediction);
  const LogRgb depth = ContrastOf(open, dark);
  if (!cell.sunny || !cell.shaded) {
    SetStepDensities(cell, Brightness(depth), depth, &prediction);
    return prediction;
  }
  const LogRgb seen = SeenContrast(cell);
  const LogRgb none = ContrastOf(part.light.sky, cell.shaded->light.sky);
  const double sigma = ContrastError(cell), brightness = Brightness(seen);
  const double full = Brightness(depth);
  const double density = (1 - kElsewhere) * Normal(brightness - Brightness(none), sigma) *
                             ColorDensity(seen, none, kColorError) +
                         kElsewhere * Between(brightness, -full, full, sigma) *
                             ColorDensity(seen, ShadowOf(brightness, {}, depth), kStepColorError);
  prediction.density.fill(density);
  prediction.density[kStray] = StrayDensity(seen);
  return prediction;
}

std::array<double, kCellStates> StatePrior(const CellPrediction& prediction,
                                           UnmodelledShade shade) {
  const double shaded = prediction.in_sun ? (1 - kStrayShare) * shade.share : 0.0;
  if (!prediction.in_sun && shade.leaves && prediction.crown[0] < prediction.open) {
    // A crown darkens also what the phantoms shade.
    return {(1 - kStrayShare) * (1 - shade.share), 0, 0, 0, kStrayShare, 0,
            (1 - kStrayShare) * shade.share};
  }
  const double open = 1 - kStrayShare - shaded;
  const auto& of = shade.leaves ? kLeaves : kSolid;
  std::array<double, kCellStates> prior{open, 0.0, shaded * of[2], shaded * of[3], kStrayShare};
  prior[shade.leaves ? kFiltered : kPartial] = shaded * of[1];
  if (shade.leaves) {
    prior[kBand + shade.band] = shaded * of[0];
    // The more shade there is, the more of what is open lies beneath the crown.
    prior[kOpen] = open * kOpenBetweenLeaves * (1 - shade.share);
    prior[kGap] = open * kOpenBetweenLeaves * shade.share;
    prior[kNearlyOpen] = open * (1 - kOpenBetweenLeaves);
  } else {
    prior[kDark] = shaded * of[0];
  }
  return prior;
}

}  // namespace pleinair::compositor
