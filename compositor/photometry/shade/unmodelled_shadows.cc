#include "compositor/photometry/shade/unmodelled_shadows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "compositor/photometry/shade/shadow_cell.h"
#include "compositor/photometry/shade/sunlit_levels.h"

namespace pleinair::compositor {
namespace {

using Rgb = std::array<double, 3>;

constexpr double kGrazing = 0.2;
constexpr std::size_t kFewestSpots = 12;
// Of the cells that the model has in the sun, the darkest beside their surface's open level.
constexpr double kDeepestShare = 0.4;

// Beside a phantom's own edge: so many spots in the sun; darker by this share of a shadow's depth
// than the brightest places, of which so many are darker, for leaves leave a part of the sun.
constexpr std::size_t kFewestBesideEdge = 6;
constexpr double kDimDepth = 0.25, kOpenQuantile = 0.9;

// Share of the sun below which a spot has none of it and above which it has all: between, patterns
// that are darker or brighter than their mean and true half-light look alike.
constexpr double kNoSun = 0.1, kAllSun = 0.9;

/// How much of the sun is on every spot that the model has in the sun.
void MapSunlight(const OpenLight& light, const std::vector<std::uint8_t>& reached,
                 const SurfaceSamples& samples, const OpenSurfaces& surfaces,
                 UnmodelledShade* shade) {
  shade->sun_on_print = light.sun_on_print();
  shade->ambient_on_print = light.ambient_on_print();
  const double log_gain = std::log(shade->open_gain);
  std::vector<SunlitSpot> spots;
  for (std::size_t i = 0; i < samples.samples().size(); ++i) {
    const SurfaceSample& spot = samples.samples()[i];
    if (reached[i] == 0 || Dot(spot.normal, light.to_sun()) < kGrazing) continue;
    double level = std::max(0.0, log_gain) + light.log_unit() +
                   std::log(spot.albedo.g / std::numbers::pi);  // Of the print's white.
    if (spot.surface >= 0) {
      const auto found = surfaces.find(PlaneOf(spot.surface, spot.normal));
      if (found == surfaces.end() || found->second.medians.size() < kFewestCells) continue;
      level = found->second.level;
    }
    const double brightness = (spot.log_rgb[0] + spot.log_rgb[1] + spot.log_rgb[2]) / 3;
    const LinearRgb sun = light.SunOn(spot.normal), sky = light.sky();
    const double ambient_share = sky.g / (sky.g + sun.g);
    const double share = (std::exp(brightness - level) - ambient_share) / (1 - ambient_share);
    const double t = std::clamp((share - kNoSun) / (kAllSun - kNoSun), 0.0, 1.0);
    spots.push_back({spot.point.xyz, t * t * (3 - 2 * t), spot.footprint_m});
  }
  shade->sunlight = MapSeenSunlight(light.to_sun(), spots);
}

/// Looks at the sunny sides of the phantoms' own shadows.
void CountShadedEdges(const std::vector<ShadeCell>& cells, const OpenSurfaces& sunlit,
                      UnmodelledShade* shade) {
  int shaded = 0;
  shade->beside_edges = 0;
  for (const ShadeCell& cell : cells) {
    const auto surface = sunlit.find(cell.Plane());
    if (!cell.unlit || cell.in_sun.size() < kFewestBesideEdge || surface == sunlit.end()) continue;
    const double open = surface->second.all_shaded
                            ? surface->second.level
                            : Quantile(surface->second.medians, kOpenQuantile);
    ++shade->beside_edges;
    shaded += Quantile(cell.in_sun, 0.5) < open - kDimDepth * cell.depth ? 1 : 0;
  }
  if (shade->beside_edges > 0) {
    shade->edges_shaded = static_cast<double>(shaded) / shade->beside_edges;
  }
}

/// The share of the cells that the model has wholly in the sun that are darker than their
/// surface's `level` by so much as shade.
template <typename Level>
double ShadedShare(const std::vector<ShadeCell>& cells, const OpenSurfaces& sunlit,
                   const Level& level, int* count) {
  int shaded = 0;
  *count = 0;
  for (const ShadeCell& cell : cells) {
    if (!cell.lit || cell.unlit) continue;
    ++*count;
    const double open = level(sunlit.at(cell.Plane()));
    shaded += cell.Median() < open - kShadeDepth * cell.depth ? 1 : 0;
  }
  return *count > 0 ? static_cast<double>(shaded) / *count : 0.0;
}

/// Looks at the places that the model has in the sun. Of a ground that hardly has a place in the
/// open its few brightest tell: most of it is as dark as the rest, but not as all the sun.
void CountShaded(const std::vector<ShadeCell>& cells, const OpenSurfaces& sunlit,
                 UnmodelledShade* shade) {
  shade->shaded = ShadedShare(
      cells, sunlit, [](const OpenSurface& surface) { return surface.SunlitLevel(); },
      &shade->sunlit);
  shade->dim = ShadedShare(
      cells, sunlit, [](const OpenSurface& surface) { return surface.level; }, &shade->sunlit);
  if (shade->IsWide()) shade->shaded = std::max(shade->shaded, shade->dim);
}

/// The darkest places beside their surfaces' open levels.
std::vector<ShadeCrossing> DeepestPlaces(const std::vector<ShadeCell>& cells,
                                         const OpenSurfaces& sunlit) {
  struct Place {
    double contrast = 0.0;
    const ShadeCell* cell = nullptr;
  };
  std::vector<Place> places;
  for (const ShadeCell& cell : cells) {
    if (!cell.lit || cell.unlit) continue;
    const OpenSurface& surface = sunlit.at(cell.Plane());
    if (surface.medians.size() < kFewestCells) continue;
    places.push_back({surface.level - cell.Median(), &cell});
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.contrast > b.contrast; });
  places.resize(static_cast<std::size_t>(kDeepestShare * static_cast<double>(places.size())));
  std::vector<ShadeCrossing> deepest;
  deepest.reserve(places.size());
  for (const auto& [contrast, cell] : places) deepest.push_back(DeepPlaceOf(*cell, contrast));
  return deepest;
}

}  // namespace

UnmodelledShade FindUnmodelledShade(const LightSolver& solver, const SurfaceSamples& samples,
                                    const LightMeter& meter, const sky::SkyModel& day,
                                    const Mat3& marker_from_world, LinearRgb sky_scale) {
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
  std::vector<ShadeCell> cells(samples.cells());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const SurfaceSample& spot = all[i];
    const double cosine = Dot(spot.normal, to_sun);
    if (spot.frames == 0 || spot.surface < 0 || cosine < kGrazing) continue;
    ShadeCell& cell = cells[spot.cell];
    const auto& rgb = spot.log_rgb;
    cell.spots.push_back(
        {(rgb[0] + rgb[1] + rgb[2]) / 3, {rgb[0] - rgb[1], rgb[2] - rgb[1]}, spot.point.xyz});
    (reached[i] != 0 ? cell.lit : cell.unlit) = true;
    if (reached[i] != 0) cell.in_sun.push_back(cell.spots.back().value);
    const auto depth = [&](double of_sun, double of_sky) {
      return std::log1p(of_sun * cosine / of_sky);
    };
    const Rgb depths{depth(sun.r, sky.r), depth(sun.g, sky.g), depth(sun.b, sky.b)};
    cell.depth = depths[1];
    cell.colour_step = {depths[0] - depths[1], depths[2] - depths[1]};
    cell.surface = spot.surface;
    cell.normal = spot.normal;
  }
  std::erase_if(cells, [](const ShadeCell& cell) { return cell.spots.size() < kFewestSpots; });
  int edges = 0;
  // Medians of the cells that the model has in the sun, by plane and material.
  OpenSurfaces sunlit;
  for (ShadeCell& cell : cells) {
    ++shade.places;
    std::sort(cell.spots.begin(), cell.spots.end(),
              [](const ShadeSpot& a, const ShadeSpot& b) { return a.value < b.value; });
    const TwoLevels levels = SplitInTwo(cell.spots);
    const bool crossed = IsCrossed(cell, levels);
    edges += crossed ? 1 : 0;
    if (!cell.lit || cell.unlit) continue;
    OpenSurface& surface = sunlit[cell.Plane()];
    surface.normal = cell.normal;
    surface.medians.push_back(cell.Median());
    surface.tops.push_back(cell.spots[cell.spots.size() * 3 / 4].value);
    surface.depth = cell.depth;
    if (crossed) shade.crossings.push_back(CrossingOf(cell, levels));
  }
  if (shade.places > 0) shade.edges = static_cast<double>(edges) / shade.places;
  shade.crossed = edges;
  for (auto& [plane, surface] : sunlit) surface.level = surface.BrightLevel();
  CountShaded(cells, sunlit, &shade);
  CountShadedEdges(cells, sunlit, &shade);
  if ((!shade.Matters() && !shade.HidesEdges()) || meter.places().empty()) return shade;
  const OpenLight light(solver, meter, day, marker_from_world, sky_scale);
  const OpenGain gain = FindOpenLevels(light, reached, samples, &sunlit);
  shade.open_gain = std::exp(gain.log);
  shade.open_gain_agreed = gain.agreed;
  shade.shown_beside_print = gain.shown_beside_print;
  // Once more, with the levels of surfaces that have no part in the open.
  CountShaded(cells, sunlit, &shade);
  CountShadedEdges(cells, sunlit, &shade);
  shade.deepest = DeepestPlaces(cells, sunlit);
  if (shade.Matters()) MapSunlight(light, reached, samples, sunlit, &shade);
  return shade;
}

bool UnmodelledShade::CastBySun() const {
  constexpr int kFewestEdges = 3;
  constexpr double kSmallestShare = 0.008;
  return crossed >= kFewestEdges && edges >= kSmallestShare;
}

bool UnmodelledShade::IsWide() const {
  constexpr double kSmallestShare = 0.15;
  return dim >= kSmallestShare;
}

bool UnmodelledShade::ShadesPrint() const {
  constexpr double kDarker = 1.5, kDarkerAsShown = 1.2;
  return open_gain_agreed && open_gain > (shown_beside_print ? kDarkerAsShown : kDarker);
}

bool UnmodelledShade::HidesEdges() const {
  constexpr int kFewestPlaces = 6;
  constexpr double kMax = 0.6;
  return beside_edges >= kFewestPlaces && edges_shaded >= kMax;
}

bool UnmodelledShade::Matters() const {
  constexpr double kSmallestShare = 0.02;
  return shaded >= kSmallestShare;
}

}  // namespace pleinair::compositor
