#include "compositor/photometry/shade/shadow_cell.h"

#include <algorithm>
#include <cmath>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

// An edge: two levels apart by this share of a shadow's depth, each of so many of the spots.
constexpr double kEdgeDepth = 0.5, kSideShare = 0.12;
// Spread about either level, of the distance between them; an even spread has 0.29.
constexpr double kSharpness = 0.24, kSharp = 0.13;
// Apartness(): bricks and joints lie among each other, sun and shade do not.
constexpr double kApart = 0.7;
// How much more or less than a shadow an edge may change colour, logarithmic.
constexpr double kLargestColourOff = 0.35;
// Logarithmic; paving and walls have smaller steps of their own.
constexpr double kSmallestStep = 0.4;
/// How far apart the middles of the first and of the other spots are, of all spots' distance from
/// their middle: 1.2 for halves of a disc, near 0 where they lie among each other.
double Apartness(const std::vector<ShadeSpot>& spots, std::size_t first) {
  const auto middle = [&](std::size_t from, std::size_t to) {
    Vec3 sum;
    for (std::size_t i = from; i < to; ++i) sum = sum + spots[i].point;
    return sum * (1.0 / static_cast<double>(to - from));
  };
  const Vec3 all = middle(0, spots.size());
  double square = 0.0;
  for (const ShadeSpot& spot : spots) square += Dot(spot.point - all, spot.point - all);
  const double radius = std::sqrt(square / static_cast<double>(spots.size()));
  return radius > 0.0 ? Norm(middle(0, first) - middle(first, spots.size())) / radius : 0.0;
}

/// Whether the change of colour from its dark spots to its bright ones is what sun and sky make.
bool ChangesColourAsShadowsDo(const ShadeCell& cell, const TwoLevels& levels) {
  const double share = (levels.high - levels.low) / cell.depth;
  for (const std::size_t k : {0, 1}) {
    double low = 0.0, high = 0.0;
    for (std::size_t i = 0; i < cell.spots.size(); ++i) {
      (i < levels.low_count ? low : high) += cell.spots[i].colour[k];
    }
    low /= static_cast<double>(levels.low_count);
    high /= static_cast<double>(cell.spots.size() - levels.low_count);
    if (std::fabs(high - low - share * cell.colour_step[k]) > kLargestColourOff) return false;
  }
  return true;
}

/// The spot nearest to the middle of them all.
Point<Marker> NearestToMiddle(const ShadeCell& cell) {
  Vec3 middle;
  for (const ShadeSpot& spot : cell.spots) middle = middle + spot.point;
  middle = middle * (1.0 / static_cast<double>(cell.spots.size()));
  const auto nearest = std::min_element(cell.spots.begin(), cell.spots.end(),
                                        [&](const ShadeSpot& a, const ShadeSpot& b) {
                                          return Norm(a.point - middle) < Norm(b.point - middle);
                                        });
  return {nearest->point};
}

}  // namespace

TwoLevels SplitInTwo(const std::vector<ShadeSpot>& sorted) {
  // Every split is tried: there are few.
  double sum = 0.0, square = 0.0;
  for (const ShadeSpot& spot : sorted) {
    sum += spot.value;
    square += spot.value * spot.value;
  }
  const auto n = static_cast<double>(sorted.size());
  TwoLevels best;
  double least = 1e300, below = 0.0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    below += sorted[i - 1].value;
    const auto m = static_cast<double>(i);
    const double low = below / m, high = (sum - below) / (n - m);
    const double rest = square - m * low * low - (n - m) * high * high;
    if (rest >= least) continue;
    least = rest;
    best = {low, high, std::sqrt(std::max(0.0, rest / n)), m / n, i};
  }
  return best;
}

bool IsSharp(const TwoLevels& levels) {
  return levels.spread < kSharp * (levels.high - levels.low);
}

bool IsCrossed(const ShadeCell& cell, const TwoLevels& levels) {
  const double apart = levels.high - levels.low;
  const bool two = apart > std::max(kEdgeDepth * cell.depth, kSmallestStep) &&
                   levels.low_share > kSideShare && levels.low_share < 1 - kSideShare &&
                   levels.spread < kSharpness * apart;
  // A pole's shadow lies in the middle of a cell, the sun on both sides of it; but it is sharp.
  return two && (IsSharp(levels) || Apartness(cell.spots, levels.low_count) > kApart) &&
         ChangesColourAsShadowsDo(cell, levels);
}

ShadeCrossing CrossingOf(const ShadeCell& cell, const TwoLevels& levels) {
  const auto median = [&](std::size_t from, std::size_t to, auto value) {
    std::vector<double> values;
    for (std::size_t i = from; i < to; ++i) values.push_back(value(cell.spots[i]));
    return Quantile(values, 0.5);
  };
  const auto step = [&](auto value) {
    return median(levels.low_count, cell.spots.size(), value) - median(0, levels.low_count, value);
  };
  const double mean = step([](const ShadeSpot& spot) { return spot.value; });
  const double red = step([](const ShadeSpot& spot) { return spot.colour[0]; });
  const double blue = step([](const ShadeSpot& spot) { return spot.colour[1]; });
  const double green = mean - (red + blue) / 3;
  return {NearestToMiddle(cell), cell.normal, {green + red, green, green + blue}};
}

ShadeCrossing DeepPlaceOf(const ShadeCell& cell, double contrast) {
  const double green = cell.depth;
  const LinearRgb depth{green + cell.colour_step[0], green, green + cell.colour_step[1]};
  return {NearestToMiddle(cell), cell.normal,
          depth * (3 * contrast / (depth.r + depth.g + depth.b))};
}

}  // namespace pleinair::compositor
