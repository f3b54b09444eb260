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
constexpr std::size_t kMinSurfaceSamples = 12;
// Share of the cells that are darkest relative to their surface's sunlit level.
constexpr double kDeepestShare = 0.4;

// Beside a phantom's own edge: minimum number of sunlit surface samples. Second: share of a
// shadow's depth by which they are darker than the brightest places. Third: quantile of the
// brightest places, because leaves transmit a part of the sun.
constexpr std::size_t kMinCountBesideEdge = 6;
constexpr double kDimDepth = 0.25, kSunlitReferenceQuantile = 0.9;

// Share of the sun below which a surface sample has none, and above which it has all. In between,
// patterns and true half-light cannot be separated.
constexpr double kNoSun = 0.1, kAllSun = 0.9;
// Share of a shadow's depth below the sunlit level from which on a cell is not in the sun.
constexpr double kOpenDepth = 0.3;

/// Estimates the sun's share at every surface sample that the model has in the sun.
void MapSunlight(const SunlitIrradiance& light, const std::vector<std::uint8_t>& sun_visible,
                 const SurfaceSamples& samples, const SunlitSurfaces& surfaces,
                 const std::vector<std::uint8_t>& open, UnmodelledShadows* unmodelled) {
  unmodelled->on_marker.sun = light.sun_on_marker();
  unmodelled->on_marker.ambient = light.ambient_on_marker();
  const double log_exposure_scale = std::log(unmodelled->sunlit_scale.ratio);
  std::vector<SunlitSample> surface_samples;
  for (std::size_t i = 0; i < samples.samples().size(); ++i) {
    const SurfaceSample& surface_sample = samples.samples()[i];
    if (sun_visible[i] == 0 || Dot(surface_sample.normal, light.to_sun()) < kGrazing) continue;
    double level = std::max(0.0, log_exposure_scale) + light.log_unit() +
                   std::log(surface_sample.albedo.g / std::numbers::pi);  // For the marker's white.
    if (surface_sample.surface >= 0) {
      const auto found = surfaces.find(PlaneOf(surface_sample.surface, surface_sample.normal));
      if (found == surfaces.end() || found->second.medians.size() < kMinCells) continue;
      level = found->second.level;
    }
    const double brightness =
        (surface_sample.log_rgb[0] + surface_sample.log_rgb[1] + surface_sample.log_rgb[2]) / 3;
    const LinearRgb sun = light.SunOn(surface_sample.normal), sky = light.sky();
    const double ambient_share = sky.g / (sky.g + sun.g);
    const double share = open[surface_sample.cell] != 0
                             ? 1.0
                             : (std::exp(brightness - level) - ambient_share) / (1 - ambient_share);
    const double t = std::clamp((share - kNoSun) / (kAllSun - kNoSun), 0.0, 1.0);
    surface_samples.push_back(
        {surface_sample.point.xyz, t * t * (3 - 2 * t), surface_sample.footprint_m});
  }
  unmodelled->sun_transmittance = BuildSunTransmittanceMap(light.to_sun(), surface_samples);
}

/// Measures the sunny sides of the phantoms' own shadows.
void CountShadedEdges(const std::vector<ShadowCell>& cells, const SunlitSurfaces& sunlit,
                      UnmodelledShadows* unmodelled) {
  int shaded = 0;
  unmodelled->sunny_sides.places = 0;
  for (const ShadowCell& cell : cells) {
    const auto surface = sunlit.find(cell.Plane());
    if (!cell.unlit || cell.in_sun.size() < kMinCountBesideEdge || surface == sunlit.end())
      continue;
    const double open = surface->second.all_in_shadow
                            ? surface->second.level
                            : Quantile(surface->second.medians, kSunlitReferenceQuantile);
    ++unmodelled->sunny_sides.places;
    shaded += Quantile(cell.in_sun, 0.5) < open - kDimDepth * cell.depth ? 1 : 0;
  }
  if (unmodelled->sunny_sides.places > 0) {
    unmodelled->sunny_sides.shaded = static_cast<double>(shaded) / unmodelled->sunny_sides.places;
  }
}

/// Share of the wholly sunlit cells of the model that are darker than their surface's `level` by a
/// shadow's depth.
template <typename Level>
double ShadedShare(const std::vector<ShadowCell>& cells, const SunlitSurfaces& sunlit,
                   const Level& level, int* count) {
  int shaded = 0;
  *count = 0;
  for (const ShadowCell& cell : cells) {
    if (!cell.lit || cell.unlit) continue;
    ++*count;
    const double open = level(sunlit.at(cell.Plane()));
    shaded += cell.Median() < open - kShadowDepthShare * cell.depth ? 1 : 0;
  }
  return *count > 0 ? static_cast<double>(shaded) / *count : 0.0;
}

/// Measures the places that the model has in the sun. A ground with hardly any sunlit place is
/// judged by its few brightest places. Most of it is as dark as the rest, but not as bright as in
/// full sun.
void CountShaded(const std::vector<ShadowCell>& cells, const SunlitSurfaces& sunlit,
                 UnmodelledShadows* unmodelled) {
  unmodelled->shaded = ShadedShare(
      cells, sunlit, [](const SunlitSurface& surface) { return surface.SunlitLevel(); },
      &unmodelled->sunlit);
  unmodelled->dim = ShadedShare(
      cells, sunlit, [](const SunlitSurface& surface) { return surface.level; },
      &unmodelled->sunlit);
  if (unmodelled->IsWide()) unmodelled->shaded = std::max(unmodelled->shaded, unmodelled->dim);
}

/// True if the sun reaches all of the cell that the model has in the sun, as far as it is seen.
/// What is darker are joints and spots of the surface, or blur beside a phantom's own shadow.
bool IsOpen(const ShadowCell& cell, const SunlitSurfaces& sunlit) {
  const auto surface = sunlit.find(cell.Plane());
  if (cell.in_sun.empty() || surface == sunlit.end()) return false;
  const double open = surface->second.level - kOpenDepth * cell.depth;
  if (Quantile(cell.in_sun, 0.5) < open) return false;
  if (cell.unlit) return true;
  const TwoLevels levels = SplitInTwo(cell.surface_samples);
  return !HasShadowBoundary(cell, levels) || IsPatterned(cell, levels);
}

/// The darkest places relative to their surfaces' sunlit levels.
std::vector<ShadowCrossing> DeepestPlaces(const std::vector<ShadowCell>& cells,
                                          const SunlitSurfaces& sunlit) {
  struct Place {
    double contrast = 0.0;
    const ShadowCell* cell = nullptr;
  };
  std::vector<Place> places;
  for (const ShadowCell& cell : cells) {
    if (!cell.lit || cell.unlit) continue;
    const SunlitSurface& surface = sunlit.at(cell.Plane());
    if (surface.medians.size() < kMinCells) continue;
    places.push_back({surface.level - cell.Median(), &cell});
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.contrast > b.contrast; });
  places.resize(static_cast<std::size_t>(kDeepestShare * static_cast<double>(places.size())));
  std::vector<ShadowCrossing> deepest;
  deepest.reserve(places.size());
  for (const auto& [contrast, cell] : places)
    deepest.push_back(CrossingOfShadowedCell(*cell, contrast));
  return deepest;
}

}  // namespace

UnmodelledShadows FindUnmodelledShadows(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                        const MarkerLightMeter& meter, const sky::SkyModel& day,
                                        const Mat3& marker_from_world,
                                        LinearRgb sky_radiance_scale) {
  UnmodelledShadows unmodelled;
  const Vec3 to_sun = Normalized(marker_from_world * day.ToSun().xyz);
  const LinearRgb sun = day.SunNormalIrradiance();
  const LinearRgb sky = day.SkyHorizontalIrradiance() * sky_radiance_scale;
  if (day.ToSun().xyz.z <= 0.0 || Luminance(sun) <= 0.0 || Luminance(sky) <= 0.0) return unmodelled;
  const auto& all = samples.samples();
  std::vector<std::uint8_t> sun_visible(all.size());
  ParallelFor(all.size(), 0, [&](std::size_t i) {
    sun_visible[i] = all[i].frames > 0 && phantoms.IsUnoccluded(all[i].point, to_sun) ? 1 : 0;
  });
  std::vector<ShadowCell> cells(samples.cells());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const SurfaceSample& surface_sample = all[i];
    const double cosine = Dot(surface_sample.normal, to_sun);
    if (surface_sample.frames == 0 || surface_sample.surface < 0 || cosine < kGrazing) continue;
    ShadowCell& cell = cells[surface_sample.cell];
    const auto& rgb = surface_sample.log_rgb;
    cell.surface_samples.push_back({(rgb[0] + rgb[1] + rgb[2]) / 3,
                                    {rgb[0] - rgb[1], rgb[2] - rgb[1]},
                                    surface_sample.point.xyz});
    (sun_visible[i] != 0 ? cell.lit : cell.unlit) = true;
    if (sun_visible[i] != 0) cell.in_sun.push_back(cell.surface_samples.back().value);
    const auto depth = [&](double of_sun, double of_sky) {
      return std::log1p(of_sun * cosine / of_sky);
    };
    const Rgb depths{depth(sun.r, sky.r), depth(sun.g, sky.g), depth(sun.b, sky.b)};
    cell.depth = depths[1];
    cell.color_step = {depths[0] - depths[1], depths[2] - depths[1]};
    cell.surface = surface_sample.surface;
    cell.index = surface_sample.cell;
    cell.normal = surface_sample.normal;
  }
  std::erase_if(cells, [](const ShadowCell& cell) {
    return cell.surface_samples.size() < kMinSurfaceSamples;
  });
  int edges = 0;
  // Medians of the cells that the model has in the sun, by plane and material.
  SunlitSurfaces sunlit;
  for (ShadowCell& cell : cells) {
    ++unmodelled.places;
    std::sort(cell.surface_samples.begin(), cell.surface_samples.end(),
              [](const ShadowSample& a, const ShadowSample& b) { return a.value < b.value; });
    const TwoLevels levels = SplitInTwo(cell.surface_samples);
    const bool boundary_cells = HasShadowBoundary(cell, levels);
    edges += boundary_cells ? 1 : 0;
    if (!cell.lit || cell.unlit) continue;
    SunlitSurface& surface = sunlit[cell.Plane()];
    surface.normal = cell.normal;
    surface.medians.push_back(cell.Median());
    surface.tops.push_back(cell.surface_samples[cell.surface_samples.size() * 3 / 4].value);
    surface.depth = cell.depth;
    if (boundary_cells) unmodelled.crossings.push_back(CrossingOf(cell, levels));
  }
  if (unmodelled.places > 0) unmodelled.edges = static_cast<double>(edges) / unmodelled.places;
  unmodelled.boundary_cells = edges;
  for (auto& [plane, surface] : sunlit) surface.level = surface.BrightLevel();
  CountShaded(cells, sunlit, &unmodelled);
  CountShadedEdges(cells, sunlit, &unmodelled);
  if ((!unmodelled.Matters() && !unmodelled.HidesEdges()) || meter.places().empty())
    return unmodelled;
  const SunlitIrradiance light(phantoms, meter, day, marker_from_world, sky_radiance_scale);
  const SunlitScale exposure_scale = FindSunlitLevels(light, sun_visible, samples, &sunlit);
  unmodelled.sunlit_scale.ratio = std::exp(exposure_scale.log);
  unmodelled.sunlit_scale.agreed = exposure_scale.agreed;
  unmodelled.sunlit_scale.shown_by_surroundings = exposure_scale.shown_by_surroundings;
  // Again, with the levels of surfaces that lie wholly in shade.
  CountShaded(cells, sunlit, &unmodelled);
  CountShadedEdges(cells, sunlit, &unmodelled);
  unmodelled.deepest = DeepestPlaces(cells, sunlit);
  if (unmodelled.Matters()) {
    std::vector<std::uint8_t> open(samples.cells());
    for (const ShadowCell& cell : cells) open[cell.index] = IsOpen(cell, sunlit) ? 1 : 0;
    MapSunlight(light, sun_visible, samples, sunlit, open, &unmodelled);
  }
  return unmodelled;
}

bool UnmodelledShadows::CastBySun() const {
  constexpr int kMinEdges = 3;
  constexpr double kMinShare = 0.008;
  return boundary_cells >= kMinEdges && edges >= kMinShare;
}

bool UnmodelledShadows::IsWide() const {
  constexpr double kMinShare = 0.15;
  return dim >= kMinShare;
}

bool UnmodelledShadows::ShadesMarker() const {
  constexpr double kDarker = 1.5, kDarkerAsShown = 1.2;
  return sunlit_scale.agreed &&
         sunlit_scale.ratio > (sunlit_scale.shown_by_surroundings ? kDarkerAsShown : kDarker);
}

bool UnmodelledShadows::HidesEdges() const {
  constexpr int kMinPlaces = 6;
  constexpr double kMax = 0.6;
  return sunny_sides.places >= kMinPlaces && sunny_sides.shaded >= kMax;
}

bool UnmodelledShadows::Matters() const {
  constexpr double kMinShare = 0.02;
  return shaded >= kMinShare;
}

}  // namespace pleinair::compositor
