#include "compositor/photometry/response/response_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {
namespace {

// Distance to a shadow edge, pixels: blur and compression mix sun and shade.
constexpr double kClear_px = 4.0;
constexpr int kDirections = 8;
// Cosine of the sun on a field over that on the best lit one: bumps decide on grazing light.
constexpr double kGrazing = 0.35;
constexpr std::size_t kMinProbes = 5;
// Error of a field: of the modelled light, and of patterns, whose probes are partly alike.
constexpr double kModelError = 0.05, kMinPattern = 0.03, kPatternFactor = 1.25;
constexpr double kIndependentProbes = 12.0;
// Spread of a sunlit field's brightness, logarithmic, from which on shade falls on it, or a coarse
// pattern. Part of the sunlit probes in such fields from which on it is shade.
constexpr double kShadeSpread = 0.3, kShadedPart = 0.4;
// From a median absolute deviation to the standard deviation of a normal distribution.
constexpr double kDeviationOfMedian = 1.4826;
// Cosine between the normals of surfaces that lie alike.
constexpr double kAlike = 0.99;

/// True if all points around a probe are as much in the sun as the probe.
bool IsClear(const LightProbe& probe, double footprint_m, double visibility,
             const PhantomRays& phantoms, Vec3 to_sun) {
  if (visibility > 0.0 && visibility < 1.0) return false;
  const Vec3 any = std::fabs(probe.normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = Normalized(Cross(probe.normal, any)), v = Cross(probe.normal, u);
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kDirections;
    const Vec3 aside = u * std::cos(angle) + v * std::sin(angle);
    const Point<Marker> at{probe.point.xyz + aside * (kClear_px * footprint_m)};
    if (phantoms.SunVisibility(at, to_sun) != visibility) return false;
  }
  return true;
}

/// Which probes can be part of a field.
std::vector<std::uint8_t> Usable(const std::vector<LightProbe>& probes,
                                 const std::vector<ProbeLight>& light, const PhantomRays& phantoms,
                                 Vec3 to_sun) {
  double brightest = 0.0;
  for (const ProbeLight& one : light) brightest = std::max(brightest, one.direct.g);
  // The marker's probes have none of their own.
  std::vector<double> footprints;
  for (const LightProbe& probe : probes) {
    if (probe.footprint_m > 0.0) footprints.push_back(probe.footprint_m);
  }
  const double usual_m = footprints.empty() ? 0.0 : Median(footprints);
  std::vector<std::uint8_t> usable(probes.size());
  ParallelFor(probes.size(), 0, [&](std::size_t i) {
    const LinearRgb& sky = light[i].sky;
    const LinearRgb& albedo = probes[i].albedo;
    if (std::min({sky.r, sky.g, sky.b, albedo.r, albedo.g, albedo.b}) <= 0.0) return;
    const bool faces = light[i].direct.g > 0.0;
    if (faces && light[i].direct.g < kGrazing * brightest) return;
    usable[i] =
        !faces || IsClear(probes[i], probes[i].footprint_m > 0.0 ? probes[i].footprint_m : usual_m,
                          light[i].sun_visibility, phantoms, to_sun)
            ? 1
            : 0;
  });
  return usable;
}

ResponseChart::Surface KindOf(int surface) {
  if (surface == kMarkerWhite) return ResponseChart::Surface::kWhite;
  return surface == kMarkerBlack ? ResponseChart::Surface::kBlack
                                 : ResponseChart::Surface::kPhantom;
}

}  // namespace

ResponseChart CollectResponseChart(const std::vector<ProbedFrame>& probed,
                                   const std::vector<std::size_t>& frames,
                                   const std::vector<LightProbe>& probes,
                                   const std::vector<ProbeLight>& light,
                                   const PhantomRays& phantoms, Vec3 to_sun) {
  ResponseChart chart;
  chart.frames = frames.size();
  const std::vector<std::uint8_t> usable = Usable(probes, light, phantoms, to_sun);
  std::map<int, std::size_t> surfaces;
  std::map<std::pair<std::array<int, 3>, bool>, std::size_t> groups;
  std::size_t sunlit_probes = 0, uneven_probes = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const ProbedFrame& frame = probed[frames[f]];
    // By surface, normal and light: entries of the frame.
    std::map<std::tuple<int, std::array<int, 3>, bool>, std::vector<std::size_t>> fields;
    for (std::size_t k = 0; k < frame.probes.size(); ++k) {
      const std::uint32_t i = frame.probes[k];
      if (usable[i] == 0) continue;
      fields[{probes[i].surface, PlaneOf(0, probes[i].normal).second, light[i].IsSunlit()}]
          .push_back(k);
    }
    for (const auto& [key, entries] : fields) {
      if (entries.size() < kMinProbes) continue;
      const auto& [surface, normal, sunlit] = key;
      ChartField field;
      field.frame = f;
      field.sunlit = sunlit;
      std::array<std::vector<double>, 3> values;
      for (const std::size_t k : entries) {
        const std::uint32_t i = frame.probes[k];
        const double share = 1.0 / static_cast<double>(entries.size());
        field.of_sun = field.of_sun + (light[i].direct * (sunlit ? light[i].sun_visibility : 0.0) +
                                       light[i].reflected) *
                                          share;
        field.of_sky = field.of_sky + light[i].sky * share;
        field.albedo = field.albedo + probes[i].albedo * share;
        for (int c = 0; c < 3; ++c) values[c].push_back(std::log(frame.linear[k][c]));
      }
      std::vector<double> deviations;
      for (int c = 0; c < 3; ++c) {
        field.log_linear[c] = Median(values[c]);
        for (const double value : values[c]) {
          deviations.push_back(std::fabs(value - field.log_linear[c]));
        }
      }
      const double spread = kDeviationOfMedian * Median(deviations);
      if (sunlit) sunlit_probes += entries.size();
      if (sunlit && spread > kShadeSpread) {
        uneven_probes += entries.size();
        continue;
      }
      const double independent = std::min(kIndependentProbes, static_cast<double>(entries.size()));
      field.error = std::hypot(
          kModelError, kPatternFactor * std::max(spread, kMinPattern) / std::sqrt(independent));
      field.surface = surfaces.try_emplace(surface, surfaces.size()).first->second;
      if (field.surface == chart.surfaces.size()) chart.surfaces.push_back(KindOf(surface));
      field.group = groups.try_emplace({normal, sunlit}, groups.size()).first->second;
      if (field.group == chart.level.size()) {
        chart.level.push_back(probes[frame.probes[entries.front()]].normal.z > kAlike);
      }
      chart.fields.push_back(field);
    }
  }
  chart.unmodelled_shadows =
      static_cast<double>(uneven_probes) > kShadedPart * static_cast<double>(sunlit_probes);
  return chart;
}

}  // namespace pleinair::compositor
