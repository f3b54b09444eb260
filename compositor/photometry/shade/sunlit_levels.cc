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

// Of a surface's cells in the open so many are darker than what counts as its sunlit level.
constexpr double kSunlitQuantile = 0.8;
// The brightest places of a surface, and how much brighter than its mean a pattern makes them.
constexpr double kOpenTop = 0.95, kPattern = 0.15;
// Logarithmic: how near surfaces' gains must be to agree.
constexpr double kAgreement = 0.26;
// Logarithmic: how much too bright beside the print surfaces of two colours must be (1.5 times), or
// of one (twice), for the print to be taken for shaded, and of how many cells, or of which share.
constexpr double kTooBright = 0.405, kTooBrightAlone = 0.693;
constexpr std::size_t kFewestBrightCells = 8;
constexpr double kLeastBrightShare = 0.05;
// Of the cells of a surface that is said to have a part in the open.
constexpr double kLeastOpenShare = 0.25;
// Cells in shade with which a surface contradicts one colour alone.
constexpr std::ptrdiff_t kFewestShadedCells = 3;
// Logarithmic: darker than the brighter ones by more than colours are misjudged.
constexpr double kSurelyDarker = 0.5;

/// What one surface tells of the gain.
struct Told {
  OpenSurface* surface = nullptr;
  Rgb colour{};
  double predicted = 0.0;  // Brightness in the open sun at the frames' gain.
  double gain = 0.0;       // Logarithmic: its level over that.
  std::size_t open = 0;    // Cells about as bright as that.
};

std::size_t Cells(const std::vector<Told>& surfaces) {
  std::size_t cells = 0;
  for (const Told& told : surfaces) cells += told.open;
  return cells;
}

double MedianGain(const std::vector<Told>& surfaces) {
  std::vector<double> gains;
  gains.reserve(Cells(surfaces));
  for (const Told& told : surfaces) gains.insert(gains.end(), told.open, told.gain);
  return gains.empty() ? 0.0 : Quantile(gains, 0.5);
}

/// What each colour tells, as the median of its surfaces of a gain above `least`.
std::vector<double> GainsByColour(const std::vector<Told>& surfaces, double least) {
  std::map<Rgb, std::vector<double>> by_colour;
  for (const Told& told : surfaces) {
    if (told.gain > least) by_colour[told.colour].push_back(told.gain);
  }
  std::vector<double> medians;
  medians.reserve(by_colour.size());
  for (const auto& [colour, gains] : by_colour) medians.push_back(Median(gains));
  return medians;
}

/// Whether surfaces of two colours at least are near `gain`.
bool ColoursAgree(const std::vector<Told>& surfaces, double gain) {
  const std::vector<double> gains =
      GainsByColour(surfaces, -std::numeric_limits<double>::infinity());
  return std::count_if(gains.begin(), gains.end(), [&](double of_colour) {
           return std::fabs(of_colour - gain) < kAgreement;
         }) > 1;
}

/// Whether a surface's cells show sun and shade: a few in shade, or a good part. Not where a shadow
/// is so faint that patterns are as deep.
bool ShowsBoth(const OpenSurface& surface, bool few) {
  if (surface.depth < kAgreement) return false;
  const double deep = kShadeDepth * surface.depth;
  if (!few) return Quantile(surface.medians, 0.9) - Quantile(surface.medians, 0.1) > deep;
  return std::count_if(surface.medians.begin(), surface.medians.end(), [&](double median) {
           return median < surface.level - deep;
         }) >= kFewestShadedCells;
}

/// Whether a darker surface shows both places in the open and some in shade, so that it does not
/// lie in shade as a whole: against one colour alone by a few of them, against more by a good part
/// and in not much fewer cells.
bool IsContradicted(const std::vector<Told>& surfaces, double gain, bool agreed,
                    std::size_t bright_cells) {
  const std::size_t fewest =
      agreed ? std::max(bright_cells / 2, kFewestBrightCells) : kFewestBrightCells;
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const Told& told) {
    const auto cells = static_cast<double>(told.surface->medians.size());
    return !told.surface->shades_print && told.gain < gain - kAgreement && told.open >= fewest &&
           static_cast<double>(told.open) > kLeastOpenShare * cells &&
           ShowsBoth(*told.surface, !agreed);
  });
}

/// The gain of the brightest surfaces that are enough to be believed; 0 without.
OpenGain BrightestGain(std::vector<Told> surfaces) {
  std::sort(surfaces.begin(), surfaces.end(),
            [](const Told& a, const Told& b) { return a.gain > b.gain; });
  const auto enough =
      std::max(kFewestBrightCells,
               static_cast<std::size_t>(kLeastBrightShare * static_cast<double>(Cells(surfaces))));
  for (std::size_t first = 0; first < surfaces.size(); ++first) {
    std::vector<Told> near;
    std::copy_if(surfaces.begin() + static_cast<std::ptrdiff_t>(first), surfaces.end(),
                 std::back_inserter(near),
                 [&](const Told& told) { return told.gain > surfaces[first].gain - kAgreement; });
    if (Cells(near) < enough) continue;
    const double gain = MedianGain(near);
    // Brighter ones, whom these contradict, say all the same that the print is too dark: between.
    const std::vector<double> colours = GainsByColour(surfaces, gain - kAgreement);
    const bool alike = ColoursAgree(near, gain);
    const bool agreed = alike || (first > 0 && colours.size() > 1);
    const bool believed = gain > (agreed ? kTooBright : kTooBrightAlone) &&
                          !IsContradicted(surfaces, gain, agreed, Cells(near));
    if (believed) {
      if (alike || gain > kTooBrightAlone) return {gain, true};
      const double sum = std::accumulate(colours.begin(), colours.end(), 0.0);
      return {sum / static_cast<double>(colours.size()), true};
    }
    if (gain <= kTooBright) break;
  }
  return {};
}

/// Marks the surface whose shade the print lies in, if one shows that.
bool MarkShadeBesidePrint(const OpenLight& light, const std::vector<std::uint8_t>& reached,
                          const SurfaceSamples& samples, OpenSurfaces* surfaces) {
  const auto beside = FindBesidePrint(samples, reached);
  const auto found = beside ? surfaces->find(beside->plane) : surfaces->end();
  if (found == surfaces->end()) return false;
  OpenSurface& surface = found->second;
  const double in_prints_light =
      light.log_unit() + MeanLog(beside->albedo * (1 / std::numbers::pi));
  // Where a shadow is no deeper than patterns are, a dark place may be a pattern.
  surface.shades_print = surface.depth >= kAgreement &&
                         std::fabs(beside->brightness - in_prints_light) < kAgreement &&
                         beside->brightness < surface.level - kShadeDepth * surface.depth;
  return surface.shades_print;
}

}  // namespace

OpenLight::OpenLight(const LightSolver& solver, const LightMeter& meter, const sky::SkyModel& day,
                     const Mat3& marker_from_world, LinearRgb sky_scale)
    : solver_(solver),
      day_(day, sky_scale, {1, 1, 1}),
      marker_from_world_(marker_from_world),
      to_sun_(Normalized(marker_from_world * day.ToSun().xyz)),
      log_unit_(MeanLog(meter.light_on_print())),
      sun_on_print_(meter.in_sun() ? SunOn({0, 0, 1}) : LinearRgb{}),
      ambient_on_print_(Ambient(meter.places(), {0, 0, 1})) {}

LinearRgb OpenLight::SunOn(Vec3 normal) const {
  return day_.SunNormalIrradiance() * std::max(0.0, Dot(normal, to_sun_));
}

LinearRgb OpenLight::Ambient(const std::vector<Point<Marker>>& places, Vec3 normal) const {
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

std::vector<double> OpenSurface::SunlitCells() const {
  const double shade = Quantile(medians, kSunlitQuantile) - kShadeDepth * depth;
  std::vector<double> open;
  std::copy_if(medians.begin(), medians.end(), std::back_inserter(open),
               [&](double value) { return value >= shade; });
  return open;
}

double OpenSurface::BrightLevel() const {
  // Where leaves leave half-light everywhere, few places lie in the open.
  return std::max(Quantile(SunlitCells(), 0.5), Quantile(tops, kOpenTop) - kPattern);
}

double OpenSurface::SunlitLevel() const {
  return all_shaded ? level : Quantile(medians, kSunlitQuantile);
}

OpenGain FindOpenLevels(const OpenLight& light, const std::vector<std::uint8_t>& reached,
                        const SurfaceSamples& samples, OpenSurfaces* surfaces) {
  struct Places {
    LinearRgb albedo;
    std::vector<Point<Marker>> lit;
  };
  std::map<SurfacePlane, Places> places;
  for (std::size_t i = 0; i < samples.samples().size(); ++i) {
    if (reached[i] == 0) continue;
    const SurfaceSample& spot = samples.samples()[i];
    Places& of = places[PlaneOf(spot.surface, spot.normal)];
    of.albedo = spot.albedo;
    of.lit.push_back(spot.point);
  }
  const LinearRgb on_print = light.sun_on_print() + light.ambient_on_print();
  std::vector<Told> all;
  for (auto& [plane, surface] : *surfaces) {
    surface.level = surface.BrightLevel();
    const auto& [albedo, lit] = places.at(plane);
    if (surface.SunlitCells().size() < kFewestCells ||
        std::min({albedo.r, albedo.g, albedo.b}) <= 0.0)
      continue;
    const LinearRgb on_surface = light.SunOn(surface.normal) + light.Ambient(lit, surface.normal);
    const double predicted =
        light.log_unit() + MeanLog(on_surface / on_print * albedo * (1 / std::numbers::pi));
    const double least = surface.level - kAgreement;
    const auto near = std::count_if(surface.medians.begin(), surface.medians.end(),
                                    [least](double median) { return median > least; });
    all.push_back({&surface,
                   {albedo.r, albedo.g, albedo.b},
                   predicted,
                   surface.level - predicted,
                   static_cast<std::size_t>(std::max<std::ptrdiff_t>(near, 1))});
  }
  const bool shown_beside_print = MarkShadeBesidePrint(light, reached, samples, surfaces);
  if (OpenGain brightest = BrightestGain(all); brightest.log > 0.0) {
    brightest.shown_beside_print = shown_beside_print;
    for (const Told& told : all) {
      if (told.gain > brightest.log - kSurelyDarker) continue;
      told.surface->all_shaded = true;
      told.surface->level = told.predicted + brightest.log;
    }
    return brightest;
  }
  const double gain = MedianGain(all);
  return {gain, !all.empty() && ColoursAgree(all, gain), shown_beside_print};
}

}  // namespace pleinair::compositor
