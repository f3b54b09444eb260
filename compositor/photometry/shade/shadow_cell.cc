#include "compositor/photometry/shade/shadow_cell.h"

#include <algorithm>
#include <cmath>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

// Shadow boundary: minimum difference of the two levels as a share of a shadow's depth, and minimum
// share of the surface samples on each level.
constexpr double kEdgeDepth = 0.5, kSideShare = 0.12;
// Spread about the levels over their difference. A uniform distribution has 0.29.
constexpr double kSharpness = 0.24, kSharp = 0.13;
// Limit for Apartness(). Bricks and joints are intermingled, sun and shade are not.
constexpr double kApart = 0.7;
// Maximum deviation of an edge's color step from a shadow's, logarithmic.
constexpr double kMaxColorOffset = 0.35;
// Logarithmic. Paving and walls have smaller steps of their own.
constexpr double kMinStep = 0.4;
/// Distance between the centroids of the first and of the other surface samples, over the root mean
/// square radius of all. 1.2 for halves of a disc, near 0 for intermingled samples.
double Apartness(const std::vector<ShadowSample>& surface_samples, std::size_t first) {
  const auto middle = [&](std::size_t from, std::size_t to) {
    Vec3 sum;
    for (std::size_t i = from; i < to; ++i) sum = sum + surface_samples[i].point;
    return sum * (1.0 / static_cast<double>(to - from));
  };
  const Vec3 all = middle(0, surface_samples.size());
  double square = 0.0;
  for (const ShadowSample& surface_sample : surface_samples)
    square += Dot(surface_sample.point - all, surface_sample.point - all);
  const double radius = std::sqrt(square / static_cast<double>(surface_samples.size()));
  return radius > 0.0 ? Norm(middle(0, first) - middle(first, surface_samples.size())) / radius
                      : 0.0;
}

/// Color of the brighter samples over that of the darker ones, logarithms of red and blue over
/// green; and what it would be if a shadow made the step.
struct ColorStep {
  std::array<double, 2> seen{}, of_shadow{};
};

ColorStep ColorStepOf(const ShadowCell& cell, const TwoLevels& levels) {
  ColorStep step;
  const double share = (levels.high - levels.low) / cell.depth;
  for (const std::size_t k : {0, 1}) {
    double low = 0.0, high = 0.0;
    for (std::size_t i = 0; i < cell.surface_samples.size(); ++i) {
      (i < levels.low_count ? low : high) += cell.surface_samples[i].color[k];
    }
    low /= static_cast<double>(levels.low_count);
    high /= static_cast<double>(cell.surface_samples.size() - levels.low_count);
    step.seen[k] = high - low;
    step.of_shadow[k] = share * cell.color_step[k];
  }
  return step;
}

/// True if the color step from the dark to the bright surface samples is that between sky and sun.
bool ChangesColorAsShadowsDo(const ShadowCell& cell, const TwoLevels& levels) {
  const ColorStep step = ColorStepOf(cell, levels);
  return std::fabs(step.seen[0] - step.of_shadow[0]) <= kMaxColorOffset &&
         std::fabs(step.seen[1] - step.of_shadow[1]) <= kMaxColorOffset;
}

/// The surface sample nearest to the centroid.
Point<Marker> NearestToMiddle(const ShadowCell& cell) {
  Vec3 middle;
  for (const ShadowSample& surface_sample : cell.surface_samples)
    middle = middle + surface_sample.point;
  middle = middle * (1.0 / static_cast<double>(cell.surface_samples.size()));
  const auto nearest = std::min_element(cell.surface_samples.begin(), cell.surface_samples.end(),
                                        [&](const ShadowSample& a, const ShadowSample& b) {
                                          return Norm(a.point - middle) < Norm(b.point - middle);
                                        });
  return {nearest->point};
}

}  // namespace

TwoLevels SplitInTwo(const std::vector<ShadowSample>& sorted) {
  // Tries every split: there are few.
  double sum = 0.0, square = 0.0;
  for (const ShadowSample& surface_sample : sorted) {
    sum += surface_sample.value;
    square += surface_sample.value * surface_sample.value;
  }
  const auto n = static_cast<double>(sorted.size());
  TwoLevels best;
  double minimum = 1e300, below = 0.0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    below += sorted[i - 1].value;
    const auto m = static_cast<double>(i);
    const double low = below / m, high = (sum - below) / (n - m);
    const double rest = square - m * low * low - (n - m) * high * high;
    if (rest >= minimum) continue;
    minimum = rest;
    best = {low, high, std::sqrt(std::max(0.0, rest / n)), m / n, i};
  }
  return best;
}

bool IsSharp(const TwoLevels& levels) {
  return levels.spread < kSharp * (levels.high - levels.low);
}

bool AreTwoSides(const std::vector<ShadowSample>& sorted, const TwoLevels& levels) {
  // A pole's shadow lies in the middle of a cell, with sun on both sides, but it is sharp.
  return levels.low_share > kSideShare && levels.low_share < 1 - kSideShare &&
         levels.spread < kSharpness * (levels.high - levels.low) &&
         (IsSharp(levels) || Apartness(sorted, levels.low_count) > kApart);
}

bool HasShadowBoundary(const ShadowCell& cell, const TwoLevels& levels) {
  const double apart = levels.high - levels.low;
  return apart > std::max(kEdgeDepth * cell.depth, kMinStep) &&
         AreTwoSides(cell.surface_samples, levels) && ChangesColorAsShadowsDo(cell, levels);
}

bool IsPatterned(const ShadowCell& cell, const TwoLevels& levels) {
  const auto [seen, of_shadow] = ColorStepOf(cell, levels);
  return std::hypot(seen[0], seen[1]) < std::hypot(seen[0] - of_shadow[0], seen[1] - of_shadow[1]);
}

ShadowCrossing CrossingOf(const ShadowCell& cell, const TwoLevels& levels) {
  const auto median = [&](std::size_t from, std::size_t to, auto value) {
    std::vector<double> values;
    for (std::size_t i = from; i < to; ++i) values.push_back(value(cell.surface_samples[i]));
    return Quantile(values, 0.5);
  };
  const auto step = [&](auto value) {
    return median(levels.low_count, cell.surface_samples.size(), value) -
           median(0, levels.low_count, value);
  };
  const double mean = step([](const ShadowSample& surface_sample) { return surface_sample.value; });
  const double red =
      step([](const ShadowSample& surface_sample) { return surface_sample.color[0]; });
  const double blue =
      step([](const ShadowSample& surface_sample) { return surface_sample.color[1]; });
  const double green = mean - (red + blue) / 3;
  return {NearestToMiddle(cell), cell.normal, {green + red, green, green + blue}};
}

ShadowCrossing CrossingOfShadowedCell(const ShadowCell& cell, double contrast) {
  const double green = cell.depth;
  const LinearRgb depth{green + cell.color_step[0], green, green + cell.color_step[1]};
  return {NearestToMiddle(cell), cell.normal,
          depth * (3 * contrast / (depth.r + depth.g + depth.b))};
}

}  // namespace pleinair::compositor
