#include "compositor/photometry/shade/sunlit_levels.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/quantile.h"
#include "compositor/photometry/marker/marker_surroundings.h"

namespace pleinair::compositor {
namespace {

using Rgb = std::array<double, 3>;

// Quantile of a surface's sunlit cells that defines its sunlit reference brightness.
constexpr double kSunlitQuantile = 0.8;
// Quantile of a surface's brightest places, and their logarithmic excess over the mean due to
// patterns.
constexpr double kSunlitTop = 0.95, kPattern = 0.15;
// Maximum logarithmic difference of exposure scales that agree.
constexpr double kAgreement = 0.26;
// Conditions for a shaded marker. Logarithmic excess of brightness beside the marker on surfaces of
// two colors (1.5 times), or of one color (twice). Minimum number and share of such cells.
constexpr double kTooBright = 0.405, kTooBrightAlone = 0.693;
constexpr std::size_t kMinBrightCells = 8;
constexpr double kMinBrightShare = 0.05;
// Minimum share of a surface's cells for a part in direct sunlight.
constexpr double kMinSunlitShare = 0.25;
// Number of shaded cells by which a surface contradicts a single color.
constexpr std::ptrdiff_t kMinShadowedCells = 3;
// Logarithmic difference that errors of described colors do not explain.
constexpr double kSurelyDarker = 0.5;

/// Exposure scale estimate of one surface.
struct SunlitEstimate {
  SunlitSurface* surface = nullptr;
  Rgb color{};
  double predicted = 0.0;       // Brightness in direct sunlight at the frames' exposure scale.
  double exposure_scale = 0.0;  // Logarithm of the surface's level over the predicted one.
  std::size_t open = 0;         // Cells at about this level.
};

std::size_t Cells(const std::vector<SunlitEstimate>& surfaces) {
  std::size_t cells = 0;
  for (const SunlitEstimate& estimate : surfaces) cells += estimate.open;
  return cells;
}

double MedianExposureScale(const std::vector<SunlitEstimate>& surfaces) {
  std::vector<double> exposure_scales;
  exposure_scales.reserve(Cells(surfaces));
  for (const SunlitEstimate& estimate : surfaces)
    exposure_scales.insert(exposure_scales.end(), estimate.open, estimate.exposure_scale);
  return exposure_scales.empty() ? 0.0 : Quantile(exposure_scales, 0.5);
}

/// Estimate of each color: the median of its surfaces' exposure scales above `floor`.
std::vector<double> ScalesByColor(const std::vector<SunlitEstimate>& surfaces, double floor) {
  std::map<Rgb, std::vector<double>> by_color;
  for (const SunlitEstimate& estimate : surfaces) {
    if (estimate.exposure_scale > floor)
      by_color[estimate.color].push_back(estimate.exposure_scale);
  }
  std::vector<double> medians;
  medians.reserve(by_color.size());
  for (const auto& [color, exposure_scales] : by_color) medians.push_back(Median(exposure_scales));
  return medians;
}

/// True if surfaces of at least two colors agree with `exposure_scale`.
bool ColorsAgree(const std::vector<SunlitEstimate>& surfaces, double exposure_scale) {
  const std::vector<double> exposure_scales =
      ScalesByColor(surfaces, -std::numeric_limits<double>::infinity());
  return std::count_if(exposure_scales.begin(), exposure_scales.end(), [&](double of_color) {
           return std::fabs(of_color - exposure_scale) < kAgreement;
         }) > 1;
}

/// True if a surface's cells show sun and shade: a few shaded cells, or a good part. False where a
/// shadow is so faint that patterns are as deep.
bool ShowsBoth(const SunlitSurface& surface, bool few) {
  if (surface.depth < kAgreement) return false;
  const double deep = kShadowDepthShare * surface.depth;
  if (!few) return Quantile(surface.medians, 0.9) - Quantile(surface.medians, 0.1) > deep;
  return std::count_if(surface.medians.begin(), surface.medians.end(), [&](double median) {
           return median < surface.level - deep;
         }) >= kMinShadowedCells;
}

/// True if a darker surface has both sunlit and shaded places, so that it does not lie wholly in
/// shade. A few shaded places contradict one color alone. A good part, in not much fewer cells,
/// contradicts several colors.
bool IsContradicted(const std::vector<SunlitEstimate>& surfaces, double exposure_scale, bool agreed,
                    std::size_t bright_cells) {
  const std::size_t min_count =
      agreed ? std::max(bright_cells / 2, kMinBrightCells) : kMinBrightCells;
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const SunlitEstimate& estimate) {
    const auto cells = static_cast<double>(estimate.surface->medians.size());
    return !estimate.surface->shades_marker &&
           estimate.exposure_scale < exposure_scale - kAgreement && estimate.open >= min_count &&
           static_cast<double>(estimate.open) > kMinSunlitShare * cells &&
           ShowsBoth(*estimate.surface, !agreed);
  });
}

/// Exposure scale of the brightest surfaces with enough cells; 0 if there are none.
SunlitScale BrightestScale(std::vector<SunlitEstimate> surfaces) {
  std::sort(surfaces.begin(), surfaces.end(), [](const SunlitEstimate& a, const SunlitEstimate& b) {
    return a.exposure_scale > b.exposure_scale;
  });
  const auto enough =
      std::max(kMinBrightCells,
               static_cast<std::size_t>(kMinBrightShare * static_cast<double>(Cells(surfaces))));
  for (std::size_t first = 0; first < surfaces.size(); ++first) {
    std::vector<SunlitEstimate> near;
    std::copy_if(surfaces.begin() + static_cast<std::ptrdiff_t>(first), surfaces.end(),
                 std::back_inserter(near), [&](const SunlitEstimate& estimate) {
                   return estimate.exposure_scale > surfaces[first].exposure_scale - kAgreement;
                 });
    if (Cells(near) < enough) continue;
    const double exposure_scale = MedianExposureScale(near);
    // Even brighter surfaces that these contradict also show that the marker is too dark. The mean
    // of both is used.
    const std::vector<double> colors = ScalesByColor(surfaces, exposure_scale - kAgreement);
    const bool alike = ColorsAgree(near, exposure_scale);
    const bool agreed = alike || (first > 0 && colors.size() > 1);
    const bool believed = exposure_scale > (agreed ? kTooBright : kTooBrightAlone) &&
                          !IsContradicted(surfaces, exposure_scale, agreed, Cells(near));
    if (believed) {
      if (alike || exposure_scale > kTooBrightAlone) return {exposure_scale, true};
      const double sum = std::accumulate(colors.begin(), colors.end(), 0.0);
      return {sum / static_cast<double>(colors.size()), true};
    }
    if (exposure_scale <= kTooBright) break;
  }
  return {};
}

/// Marks the surface that shades the marker with it, if one does.
bool MarkShadeAroundMarker(const SunlitIrradiance& light,
                           const std::vector<std::uint8_t>& sun_visible,
                           const SurfaceSamples& samples, SunlitSurfaces* surfaces) {
  const auto beside = FindMarkerSurroundings(samples, sun_visible);
  const auto found = beside ? surfaces->find(beside->plane) : surfaces->end();
  if (found == surfaces->end()) return false;
  SunlitSurface& surface = found->second;
  const double in_markers_light =
      light.log_unit() + MeanLog(beside->albedo * (1 / std::numbers::pi));
  // Where a shadow is no deeper than patterns are, a dark place may be a pattern.
  surface.shades_marker = surface.depth >= kAgreement &&
                          std::fabs(beside->brightness - in_markers_light) < kAgreement &&
                          beside->brightness < surface.level - kShadowDepthShare * surface.depth;
  return surface.shades_marker;
}

}  // namespace

SunlitIrradiance::SunlitIrradiance(const PhantomRays& phantoms, const MarkerLightMeter& meter,
                                   const sky::SkyModel& day, const Mat3& marker_from_world,
                                   LinearRgb sky_radiance_scale)
    : phantoms_(phantoms),
      day_(day, sky_radiance_scale, {1, 1, 1}),
      marker_from_world_(marker_from_world),
      to_sun_(Normalized(marker_from_world * day.ToSun().xyz)),
      log_unit_(MeanLog(meter.light_on_marker())),
      sun_on_marker_(meter.in_sun() ? SunOn({0, 0, 1}) : LinearRgb{}),
      ambient_on_marker_(Ambient(meter.places(), {0, 0, 1})) {}

LinearRgb SunlitIrradiance::SunOn(Vec3 normal) const {
  return day_.SunNormalIrradiance() * std::max(0.0, Dot(normal, to_sun_));
}

LinearRgb SunlitIrradiance::Ambient(const std::vector<Point<Marker>>& places, Vec3 normal) const {
  constexpr std::size_t kProbes = 12;
  constexpr std::uint32_t kPaths = 256;
  std::vector<Point<Marker>> probes;
  for (std::size_t i = 0; i < kProbes && !places.empty(); ++i) {
    probes.push_back(places[(2 * i + 1) * places.size() / (2 * kProbes)]);
  }
  LinearRgb sum;
  for (const LinearRgb& light :
       phantoms_.Ambient(probes, normal, day_, marker_from_world_, kPaths)) {
    sum = sum + light;
  }
  return sum * (1.0 / kProbes);
}

std::vector<double> SunlitSurface::SunlitCells() const {
  const double shade = Quantile(medians, kSunlitQuantile) - kShadowDepthShare * depth;
  std::vector<double> open;
  std::copy_if(medians.begin(), medians.end(), std::back_inserter(open),
               [&](double value) { return value >= shade; });
  return open;
}

double SunlitSurface::BrightLevel() const {
  // In dappled half-light few places are sunlit.
  return std::max(Quantile(SunlitCells(), 0.5), Quantile(tops, kSunlitTop) - kPattern);
}

double SunlitSurface::SunlitLevel() const {
  return all_in_shadow ? level : Quantile(medians, kSunlitQuantile);
}

SunlitScale FindSunlitLevels(const SunlitIrradiance& light,
                             const std::vector<std::uint8_t>& sun_visible,
                             const SurfaceSamples& samples, SunlitSurfaces* surfaces) {
  struct Places {
    LinearRgb albedo;
    std::vector<Point<Marker>> lit;
  };
  std::map<SurfacePlane, Places> places;
  for (std::size_t i = 0; i < samples.samples().size(); ++i) {
    if (sun_visible[i] == 0) continue;
    const SurfaceSample& surface_sample = samples.samples()[i];
    Places& of = places[PlaneOf(surface_sample.surface, surface_sample.normal)];
    of.albedo = surface_sample.albedo;
    of.lit.push_back(surface_sample.point);
  }
  const LinearRgb on_marker = light.sun_on_marker() + light.ambient_on_marker();
  std::vector<SunlitEstimate> all;
  for (auto& [plane, surface] : *surfaces) {
    surface.level = surface.BrightLevel();
    const auto& [albedo, lit] = places.at(plane);
    if (surface.SunlitCells().size() < kMinCells || std::min({albedo.r, albedo.g, albedo.b}) <= 0.0)
      continue;
    const LinearRgb on_surface = light.SunOn(surface.normal) + light.Ambient(lit, surface.normal);
    const double predicted =
        light.log_unit() + MeanLog(on_surface / on_marker * albedo * (1 / std::numbers::pi));
    const double floor = surface.level - kAgreement;
    const auto near = std::count_if(surface.medians.begin(), surface.medians.end(),
                                    [floor](double median) { return median > floor; });
    all.push_back({&surface,
                   {albedo.r, albedo.g, albedo.b},
                   predicted,
                   surface.level - predicted,
                   static_cast<std::size_t>(std::max<std::ptrdiff_t>(near, 1))});
  }
  const bool shown_by_surroundings = MarkShadeAroundMarker(light, sun_visible, samples, surfaces);
  if (SunlitScale brightest = BrightestScale(all); brightest.log > 0.0) {
    brightest.shown_by_surroundings = shown_by_surroundings;
    for (const SunlitEstimate& estimate : all) {
      if (estimate.exposure_scale > brightest.log - kSurelyDarker) continue;
      estimate.surface->all_in_shadow = true;
      estimate.surface->level = estimate.predicted + brightest.log;
    }
    return brightest;
  }
  const double exposure_scale = MedianExposureScale(all);
  return {exposure_scale, !all.empty() && ColorsAgree(all, exposure_scale), shown_by_surroundings};
}

}  // namespace pleinair::compositor
