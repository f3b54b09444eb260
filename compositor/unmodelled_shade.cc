#include "compositor/unmodelled_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "compositor/parallel_for.h"

namespace pleinair::compositor {
namespace {

constexpr double kGrazing = 0.2;
constexpr std::size_t kFewestSpots = 12;
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
// Shade: darker by this share of a shadow's depth than the surface's sunlit places, of which so
// many are darker.
constexpr double kShadeDepth = 0.5, kSunlitQuantile = 0.8;

using Rgb = std::array<double, 3>;

double Quantile(std::vector<double> values, double q) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// A spot's logarithmic brightness, and where it lies.
struct Spot {
  double value = 0.0;
  std::array<double, 2> colour{};  ///< Red and blue against green.
  Vec3 point;
};

/// Two-means on sorted spots.
struct TwoLevels {
  double low = 0.0, high = 0.0;  ///< Means.
  double spread = 0.0;           ///< Root mean square about the nearer one.
  double low_share = 0.0;
  std::size_t low_count = 0;
};
TwoLevels SplitInTwo(const std::vector<Spot>& sorted) {
  // Every split is tried: there are few.
  double sum = 0.0, square = 0.0;
  for (const Spot& spot : sorted) {
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

/// How far apart the middles of the first and of the other spots are, of all spots' distance from
/// their middle: 1.2 for halves of a disc, near 0 where they lie among each other.
double Apartness(const std::vector<Spot>& spots, std::size_t first) {
  const auto middle = [&](std::size_t from, std::size_t to) {
    Vec3 sum;
    for (std::size_t i = from; i < to; ++i) sum = sum + spots[i].point;
    return sum * (1.0 / static_cast<double>(to - from));
  };
  const Vec3 all = middle(0, spots.size());
  double square = 0.0;
  for (const Spot& spot : spots) square += Dot(spot.point - all, spot.point - all);
  const double radius = std::sqrt(square / static_cast<double>(spots.size()));
  return radius > 0.0 ? Norm(middle(0, first) - middle(first, spots.size())) / radius : 0.0;
}

struct Cell {
  std::vector<Spot> spots;
  bool lit = false, unlit = false;      // Some spot that the model has in the sun; not.
  double depth = 0.0;                   // Of a shadow there, logarithmic, green.
  std::array<double, 2> colour_step{};  // Red and blue against green.
  int surface = 0;
  Rgb normal{};

  double Median() const { return spots[spots.size() / 2].value; }  // They are sorted.
};

/// Whether the change of colour from its dark spots to its bright ones is what sun and sky make.
bool ChangesColourAsShadowsDo(const Cell& cell, const TwoLevels& levels) {
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

/// Whether a shadow's edge divides it: two sharp levels, or two on a side each.
bool IsCrossed(const Cell& cell) {
  const TwoLevels levels = SplitInTwo(cell.spots);
  const double apart = levels.high - levels.low;
  const bool two = apart > std::max(kEdgeDepth * cell.depth, kSmallestStep) &&
                   levels.low_share > kSideShare && levels.low_share < 1 - kSideShare &&
                   levels.spread < kSharpness * apart;
  // A pole's shadow lies in the middle of a cell, the sun on both sides of it; but it is sharp.
  return two &&
         (levels.spread < kSharp * apart || Apartness(cell.spots, levels.low_count) > kApart) &&
         ChangesColourAsShadowsDo(cell, levels);
}

}  // namespace

UnmodelledShade FindUnmodelledShade(const LightSolver& solver, const SurfaceSamples& samples,
                                    const sky::SkyModel& day, const Mat3& marker_from_world,
                                    LinearRgb sky_scale) {
  UnmodelledShade shade;
  const Vec3 to_sun = Normalized(marker_from_world * day.ToSun().xyz);
  const LinearRgb sun = day.SunNormalIrradiance();
  const LinearRgb sky = day.SkyHorizontalIrradiance() * sky_scale;
  if (day.ToSun().xyz.z <= 0.0 || Luminance(sun) <= 0.0 || Luminance(sky) <= 0.0) return shade;
  const auto& all = samples.samples();
  std::vector<std::uint8_t> reached(all.size());
  ParallelFor(all.size(), 0, [&](std::size_t i) {
    reached[i] = all[i].frames > 0 && solver.ReachesPhantomsOnly(all[i].point, to_sun) ? 1 : 0;
  });
  std::vector<Cell> cells(samples.cells());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const SurfaceSample& spot = all[i];
    const double cosine = Dot(spot.normal, to_sun);
    if (spot.frames == 0 || spot.surface < 0 || cosine < kGrazing) continue;
    Cell& cell = cells[spot.cell];
    const auto& rgb = spot.log_rgb;
    cell.spots.push_back(
        {(rgb[0] + rgb[1] + rgb[2]) / 3, {rgb[0] - rgb[1], rgb[2] - rgb[1]}, spot.point.xyz});
    (reached[i] != 0 ? cell.lit : cell.unlit) = true;
    const auto depth = [&](double of_sun, double of_sky) {
      return std::log1p(of_sun * cosine / of_sky);
    };
    const Rgb depths{depth(sun.r, sky.r), depth(sun.g, sky.g), depth(sun.b, sky.b)};
    cell.depth = depths[1];
    cell.colour_step = {depths[0] - depths[1], depths[2] - depths[1]};
    cell.surface = spot.surface;
    cell.normal = {spot.normal.x, spot.normal.y, spot.normal.z};
  }
  std::erase_if(cells, [](const Cell& cell) { return cell.spots.size() < kFewestSpots; });
  int edges = 0, shaded = 0;
  // Medians of the cells that the model has in the sun, by plane and material.
  std::map<std::pair<int, Rgb>, std::vector<double>> sunlit;
  for (Cell& cell : cells) {
    ++shade.places;
    std::sort(cell.spots.begin(), cell.spots.end(),
              [](const Spot& a, const Spot& b) { return a.value < b.value; });
    edges += IsCrossed(cell) ? 1 : 0;
    if (cell.lit && !cell.unlit) {
      sunlit[{cell.surface, cell.normal}].push_back(cell.Median());
    }
  }
  for (const Cell& cell : cells) {
    if (!cell.lit || cell.unlit) continue;
    const double level = Quantile(sunlit[{cell.surface, cell.normal}], kSunlitQuantile);
    ++shade.sunlit;
    shaded += cell.Median() < level - kShadeDepth * cell.depth ? 1 : 0;
  }
  if (shade.places > 0) shade.edges = static_cast<double>(edges) / shade.places;
  if (shade.sunlit > 0) shade.shaded = static_cast<double>(shaded) / shade.sunlit;
  shade.crossed = edges;
  return shade;
}

bool UnmodelledShade::CastBySun() const {
  constexpr int kFewestEdges = 3;
  constexpr double kSmallestShare = 0.008;
  return crossed >= kFewestEdges && edges >= kSmallestShare;
}

bool UnmodelledShade::Matters() const {
  constexpr double kSmallestShare = 0.02;
  return shaded >= kSmallestShare;
}

}  // namespace pleinair::compositor
