#include "compositor/photometry/marker/marker_shadow_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/quantile.h"
#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/shade/shadow_cell.h"

namespace pleinair::compositor {
namespace {

// Minimum number of pairs, and maximum share of pairs in the middle half between the two levels. A
// shadow edge as wide as half of the square leaves a fifth of the square's pairs there.
constexpr std::size_t kMinPairs = 24;
constexpr double kMaxBetween = 0.1;
// Maximum share of a part's pairs on one side of the marker.
constexpr double kMaxShareOnOneSide = 0.75;
// Step of the black over the step that its reflectance predicts. Inks, veiling glare and blur make
// it uncertain. Under a cover it is near 0, or falls where the white rises.
constexpr double kMinBlackStep = 0.4, kMaxBlackStep = 2.5;
// Share of the sky that the caster occludes, mostly the bright part around the sun, and its
// logarithmic uncertainty. The share is a guess. A band 0.2 rad wide occludes 3 % of an even sky
// and several times that in haze. Examples are a column at arm's length or a wall's edge.
constexpr double kTakenByCaster = 0.1, kCasterDoubt = 0.15;
constexpr std::uint32_t kPaths = 384;

/// The pairs as a cell of surface samples, sorted by brightness.
ShadowCell CellOf(std::span<const MarkerPair> pairs, LinearRgb depth) {
  ShadowCell cell;
  cell.normal = {0, 0, 1};
  cell.depth = depth.g;
  cell.color_step = {depth.r - depth.g, depth.b - depth.g};
  cell.surface_samples.reserve(pairs.size());
  for (const MarkerPair& pair : pairs) {
    const auto& [red, green, blue] = pair.step;
    cell.surface_samples.push_back(
        {MeanLog(pair.step), {std::log(red / green), std::log(blue / green)}, pair.place.xyz});
  }
  std::sort(cell.surface_samples.begin(), cell.surface_samples.end(),
            [](const ShadowSample& a, const ShadowSample& b) { return a.value < b.value; });
  return cell;
}

/// True if more than a few pairs lie between the levels, as in half-light.
bool HasHalfLight(const ShadowCell& cell, const TwoLevels& levels) {
  const double apart = levels.high - levels.low;
  const auto between = std::count_if(cell.surface_samples.begin(), cell.surface_samples.end(),
                                     [&](const auto& surface_sample) {
                                       return surface_sample.value > levels.low + apart / 4 &&
                                              surface_sample.value < levels.high - apart / 4;
                                     });
  return static_cast<double>(between) >
         kMaxBetween * static_cast<double>(cell.surface_samples.size());
}

/// True if enough surface samples lie beside the marker's side that has most of them. One side
/// alone may lie in half-light along its whole length, with an edge as sharp as a shadow's.
bool GoesRoundACorner(std::span<const ShadowSample> surface_samples) {
  std::array<std::size_t, 4> sides{};
  for (const ShadowSample& surface_sample : surface_samples) {
    const Vec3 p = surface_sample.point;
    const bool across = std::fabs(p.x) > std::fabs(p.y);
    const bool far = (across ? p.x : p.y) > 0.0;
    ++sides[(across ? 2U : 0U) + (far ? 1U : 0U)];
  }
  const auto maximum = static_cast<double>(*std::max_element(sides.begin(), sides.end()));
  return maximum < kMaxShareOnOneSide * static_cast<double>(surface_samples.size());
}

/// True if the black's step between the two parts agrees with its reflectance.
bool BlackFollows(std::span<const MarkerPair> pairs, double threshold, double black_share) {
  std::vector<double> dark, bright, dark_step, bright_step;
  for (const MarkerPair& pair : pairs) {
    const bool is_dark = MeanLog(pair.step) < threshold;
    (is_dark ? dark : bright).push_back(pair.black);
    (is_dark ? dark_step : bright_step).push_back(pair.step.r + pair.step.g + pair.step.b);
  }
  if (dark.empty() || bright.empty()) return false;
  const double black = Median(bright) - Median(dark);
  const double expected = (Median(bright_step) - Median(dark_step)) * black_share;
  return black > kMinBlackStep * expected && black < kMaxBlackStep * expected;
}

Point<Marker> Middle(std::span<const ShadowSample> surface_samples) {
  Vec3 sum;
  for (const ShadowSample& surface_sample : surface_samples) sum = sum + surface_sample.point;
  return {sum * (1.0 / static_cast<double>(surface_samples.size()))};
}

}  // namespace

std::optional<MarkerShadowEdge> FindMarkerShadowEdge(std::span<const MarkerPair> pairs,
                                                     LinearRgb depth, double black_share) {
  if (pairs.size() < kMinPairs || !(std::min({depth.r, depth.g, depth.b}) > 0.0)) return {};
  const ShadowCell cell = CellOf(pairs, depth);
  const TwoLevels levels = SplitInTwo(cell.surface_samples);
  if (!HasShadowBoundary(cell, levels) || !IsSharp(levels) || HasHalfLight(cell, levels)) return {};
  if (!BlackFollows(pairs, (levels.low + levels.high) / 2, black_share)) return {};
  const std::span<const ShadowSample> surface_samples(cell.surface_samples);
  const auto dark = surface_samples.first(levels.low_count),
             bright = surface_samples.subspan(levels.low_count);
  if (!GoesRoundACorner(dark) || !GoesRoundACorner(bright)) return {};
  return MarkerShadowEdge{CrossingOf(cell, levels).contrast, Middle(bright), Middle(dark)};
}

SunSkyRatio EstimateRatioFromMarkerShadow(const PhantomRays& phantoms,
                                          std::span<const MarkerShadowEdge> shadows,
                                          const sky::SkyModel& daylight,
                                          const Mat3& marker_from_world) {
  SunSkyRatio estimate;
  const Vec3 normal{0, 0, 1};
  const Vec3 to_sun = marker_from_world * daylight.ToSun().xyz;
  const double cosine = Dot(normal, to_sun);
  if (shadows.empty() || cosine < kGrazingMarkerCosine) return estimate;
  std::vector<Point<Marker>> places;
  for (const MarkerShadowEdge& shadow : shadows) {
    places.push_back(shadow.lit);
    places.push_back(shadow.shaded);
  }
  const auto light = [&](LinearRgb of_sky, LinearRgb of_sun) {
    return phantoms.Ambient(places, normal, ScaledSky(daylight, of_sky, of_sun), marker_from_world,
                            kPaths);
  };
  const std::vector<LinearRgb> sky = light({1, 1, 1}, {}), reflected = light({}, {1, 1, 1});
  const LinearRgb sun = daylight.SunNormalIrradiance() * cosine;
  std::array<std::vector<double>, 3> log_scales;
  for (std::size_t i = 0; i < shadows.size(); ++i) {
    // The model includes a phantom's occlusion of the sky. For other casters the visible share of
    // the sky is a guess.
    const bool by_phantom = !phantoms.IsUnoccluded(shadows[i].shaded, to_sun);
    const double left = by_phantom ? 1.0 : 1.0 - kTakenByCaster;
    // exp(contrast) = (k sky + reflected + sun) / (k left sky' + reflected'), solved for k.
    const auto scale = [&](auto channel) {
      const double ratio = std::exp(channel(shadows[i].contrast));
      const std::size_t lit = 2 * i, shaded = 2 * i + 1;
      return (channel(sun) + channel(reflected[lit]) - ratio * channel(reflected[shaded])) /
             (ratio * left * channel(sky[shaded]) - channel(sky[lit]));
    };
    const std::array scales{scale([](LinearRgb c) { return c.r; }),
                            scale([](LinearRgb c) { return c.g; }),
                            scale([](LinearRgb c) { return c.b; })};
    if (!std::all_of(scales.begin(), scales.end(),
                     [](double k) { return k > 0.0 && std::isfinite(k); })) {
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) log_scales[c].push_back(std::log(scales[c]));
  }
  const std::vector<double>& green = log_scales[1];
  estimate.edges = estimate.agreeing = static_cast<int>(green.size());
  if (green.empty()) return estimate;
  estimate.sun = SunSkyRatio::Sun::kShines;
  estimate.sky_radiance_scale = {std::exp(Median(log_scales[0])), std::exp(Median(green)),
                                 std::exp(Median(log_scales[2]))};
  double square = 0.0;
  for (const double log_scale : green) square += std::pow(log_scale - Median(green), 2);
  const auto count = static_cast<double>(green.size());
  estimate.log_uncertainty = std::sqrt(square / count / count + kCasterDoubt * kCasterDoubt);
  return estimate;
}

}  // namespace pleinair::compositor
