#include "compositor/unmodelled_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "base/quantile.h"
#include "compositor/parallel_for.h"
#include "compositor/scaled_daylight.h"
#include "compositor/shade_cell.h"

namespace pleinair::compositor {
namespace {

using Rgb = std::array<double, 3>;

constexpr double kGrazing = 0.2;
constexpr std::size_t kFewestSpots = 12;
// Shade: darker by this share of a shadow's depth than the surface's sunlit places, of which so
// many are darker.
constexpr double kShadeDepth = 0.5, kSunlitQuantile = 0.8;

// Beside a phantom's own edge: so many spots in the sun; darker by this share of a shadow's depth
// than the brightest places, of which so many are darker, for leaves leave a part of the sun.
constexpr std::size_t kFewestBesideEdge = 6;
constexpr double kDimDepth = 0.25, kOpenQuantile = 0.9;

// Share of the sun below which a spot has none of it and above which it has all: between, patterns
// that are darker or brighter than their mean and true half-light look alike.
constexpr double kNoSun = 0.1, kAllSun = 0.9;

/// The light on surfaces in the open sun, phantoms about them as they are.
class OpenLight {
 public:
  OpenLight(const LightSolver& solver, const LightMeter& meter, const sky::SkyModel& day,
            const Mat3& marker_from_world, LinearRgb sky_scale)
      : solver_(solver),
        day_(day, sky_scale, {1, 1, 1}),
        marker_from_world_(marker_from_world),
        to_sun_(Normalized(marker_from_world * day.ToSun().xyz)),
        log_unit_(MeanLog(meter.light_on_print())),
        sun_on_print_(meter.in_sun() ? SunOn({0, 0, 1}) : LinearRgb{}),
        ambient_on_print_(Ambient(meter.places(), {0, 0, 1})) {}

  Vec3 to_sun() const { return to_sun_; }
  LinearRgb sky() const { return day_.SkyHorizontalIrradiance(); }
  /// Mean logarithm of the light that the meter takes to be on the print, the samples' unit.
  double log_unit() const { return log_unit_; }
  LinearRgb sun_on_print() const { return sun_on_print_; }
  LinearRgb ambient_on_print() const { return ambient_on_print_; }

  LinearRgb SunOn(Vec3 normal) const {
    return day_.SunNormalIrradiance() * std::max(0.0, Dot(normal, to_sun_));
  }
  /// Mean over places that face `normal`, of which a few are asked.
  LinearRgb Ambient(const std::vector<Point<Marker>>& places, Vec3 normal) const {
    constexpr std::size_t kProbes = 12;
    constexpr std::uint32_t kPaths = 256;
    std::vector<Point<Marker>> probes;
    for (std::size_t i = 0; i < kProbes && !places.empty(); ++i) {
      probes.push_back(places[(2 * i + 1) * places.size() / (2 * kProbes)]);
    }
    LinearRgb sum;
    for (const LinearRgb& light :
         solver_.AmbientPhantomsOnly(probes, normal, day_, marker_from_world_, kPaths)) {
      sum = sum + light;
    }
    return sum * (1.0 / kProbes);
  }

 private:
  const LightSolver& solver_;
  ScaledDaylight day_;
  Mat3 marker_from_world_;
  Vec3 to_sun_;
  double log_unit_;
  LinearRgb sun_on_print_, ambient_on_print_;
};

/// A plane of one material, as far as the model has it in the sun.
struct OpenSurface {
  std::vector<double> medians;  ///< Of its cells' logarithmic brightness.
  std::vector<double> tops;     ///< Of each cell, what a quarter of its spots exceeds.
  double depth = 0.0;           ///< Of a shadow there, logarithmic.
  double level = 0.0;           ///< Brightness in the open sun: of the cells that are not in shade.
};
using OpenSurfaces = std::map<std::pair<int, Rgb>, OpenSurface>;

constexpr std::size_t kFewestCells = 4;
// The brightest places of a surface, and how much brighter than its mean a pattern makes them.
constexpr double kOpenTop = 0.95, kPattern = 0.15;
// Logarithmic: how near surfaces' gains must be to agree.
constexpr double kAgreement = 0.26;

/// The brightness of each surface in the open sun, and what gain of the camera they tell of:
/// median over their cells, since colours are stated roughly and grass reflects less than its
/// blades. Gives its logarithm.
double FindOpenLevels(const OpenLight& light, const std::vector<std::uint8_t>& reached,
                      const SurfaceSamples& samples, OpenSurfaces* surfaces, bool* agreed) {
  struct Places {
    LinearRgb albedo;
    std::vector<Point<Marker>> lit;
  };
  std::map<std::pair<int, Rgb>, Places> places;
  for (std::size_t i = 0; i < samples.samples().size(); ++i) {
    if (reached[i] == 0) continue;
    const SurfaceSample& spot = samples.samples()[i];
    Places& of = places[{spot.surface, {spot.normal.x, spot.normal.y, spot.normal.z}}];
    of.albedo = spot.albedo;
    of.lit.push_back(spot.point);
  }
  const LinearRgb on_print = light.sun_on_print() + light.ambient_on_print();
  std::vector<double> gains;
  std::map<Rgb, std::vector<double>> by_colour;
  for (auto& [key, surface] : *surfaces) {
    const double shade = Quantile(surface.medians, kSunlitQuantile) - kShadeDepth * surface.depth;
    std::vector<double> open;
    std::copy_if(surface.medians.begin(), surface.medians.end(), std::back_inserter(open),
                 [&](double value) { return value >= shade; });
    // Where leaves leave half-light everywhere, few places lie in the open.
    surface.level = std::max(Quantile(open, 0.5), Quantile(surface.tops, kOpenTop) - kPattern);
    const auto& [albedo, lit] = places.at(key);
    if (open.size() < kFewestCells || std::min({albedo.r, albedo.g, albedo.b}) <= 0.0) continue;
    const Vec3 normal{key.second[0], key.second[1], key.second[2]};
    const LinearRgb on_surface = light.SunOn(normal) + light.Ambient(lit, normal);
    const double predicted =
        light.log_unit() + MeanLog(on_surface / on_print * albedo * (1 / std::numbers::pi));
    gains.insert(gains.end(), open.size(), surface.level - predicted);
    by_colour[{albedo.r, albedo.g, albedo.b}].push_back(surface.level - predicted);
  }
  if (gains.empty()) return 0.0;
  const double gain = Quantile(gains, 0.5);
  *agreed = std::count_if(by_colour.begin(), by_colour.end(), [&](const auto& colour) {
              return std::fabs(Quantile(colour.second, 0.5) - gain) < kAgreement;
            }) > 1;
  return gain;
}

/// How much of the sun is on every spot that the model has in the sun.
void MapSunlight(const OpenLight& light, const std::vector<std::uint8_t>& reached,
                 const SurfaceSamples& samples, OpenSurfaces* surfaces, UnmodelledShade* shade) {
  const double log_gain =
      FindOpenLevels(light, reached, samples, surfaces, &shade->open_gain_agreed);
  shade->open_gain = std::exp(log_gain);
  shade->sun_on_print = light.sun_on_print();
  shade->ambient_on_print = light.ambient_on_print();
  std::vector<SunlitSpot> spots;
  for (std::size_t i = 0; i < samples.samples().size(); ++i) {
    const SurfaceSample& spot = samples.samples()[i];
    if (reached[i] == 0 || Dot(spot.normal, light.to_sun()) < kGrazing) continue;
    double level = std::max(0.0, log_gain) + light.log_unit() +
                   std::log(spot.albedo.g / std::numbers::pi);  // Of the print's white.
    if (spot.surface >= 0) {
      const auto found =
          surfaces->find({spot.surface, {spot.normal.x, spot.normal.y, spot.normal.z}});
      if (found == surfaces->end() || found->second.medians.size() < kFewestCells) continue;
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
  for (const ShadeCell& cell : cells) {
    const auto surface = sunlit.find({cell.surface, cell.normal});
    if (!cell.unlit || cell.in_sun.size() < kFewestBesideEdge || surface == sunlit.end()) continue;
    const double open = Quantile(surface->second.medians, kOpenQuantile);
    ++shade->beside_edges;
    shaded += Quantile(cell.in_sun, 0.5) < open - kDimDepth * cell.depth ? 1 : 0;
  }
  if (shade->beside_edges > 0) {
    shade->edges_shaded = static_cast<double>(shaded) / shade->beside_edges;
  }
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
    cell.normal = {spot.normal.x, spot.normal.y, spot.normal.z};
  }
  std::erase_if(cells, [](const ShadeCell& cell) { return cell.spots.size() < kFewestSpots; });
  int edges = 0, shaded = 0;
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
    OpenSurface& surface = sunlit[{cell.surface, cell.normal}];
    surface.medians.push_back(cell.Median());
    surface.tops.push_back(cell.spots[cell.spots.size() * 3 / 4].value);
    if (crossed) shade.crossings.push_back(CrossingOf(cell, levels));
  }
  for (const ShadeCell& cell : cells) {
    if (!cell.lit || cell.unlit) continue;
    OpenSurface& surface = sunlit[{cell.surface, cell.normal}];
    surface.depth = cell.depth;
    const double level = Quantile(surface.medians, kSunlitQuantile);
    ++shade.sunlit;
    shaded += cell.Median() < level - kShadeDepth * cell.depth ? 1 : 0;
  }
  CountShadedEdges(cells, sunlit, &shade);
  if (shade.places > 0) shade.edges = static_cast<double>(edges) / shade.places;
  if (shade.sunlit > 0) shade.shaded = static_cast<double>(shaded) / shade.sunlit;
  shade.crossed = edges;
  if (shade.Matters() && !meter.places().empty()) {
    MapSunlight({solver, meter, day, marker_from_world, sky_scale}, reached, samples, &sunlit,
                &shade);
  }
  return shade;
}

bool UnmodelledShade::CastBySun() const {
  constexpr int kFewestEdges = 3;
  constexpr double kSmallestShare = 0.008;
  return crossed >= kFewestEdges && edges >= kSmallestShare;
}

bool UnmodelledShade::HidesEdges() const {
  constexpr int kFewestPlaces = 6;
  constexpr double kMost = 0.6;
  return beside_edges >= kFewestPlaces && edges_shaded >= kMost;
}

bool UnmodelledShade::Matters() const {
  constexpr double kSmallestShare = 0.02;
  return shaded >= kSmallestShare;
}

}  // namespace pleinair::compositor
