#include "compositor/photometry/surface_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "compositor/photometry/shade/sunlit_levels.h"

namespace pleinair::compositor {
namespace {

// Samples of a surface that are traced, spread evenly, and paths of each.
constexpr std::size_t kTraced = 512;
constexpr std::uint32_t kPathsPerSample = 192;
// Minimum number of usable samples, and their minimum share among those seen.
constexpr std::size_t kMinSamples = 40;
constexpr double kMinUsableShare = 0.5;
// Sun visibilities of penumbras, whose place is uncertain; transmittance of unmodelled shade.
constexpr double kPenumbraFrom = 0.02, kPenumbraTo = 0.98, kMinTransmittance = 0.8;
// Maximum width of the shortest half, logarithmic: twice the interquartile range of paving. Samples
// count within this many half-widths of its middle, and within the pattern of a material.
constexpr double kMaxHalf = 0.6, kHalfWidths = 3.0, kMinReach = 0.2;
// Relative errors of the exposure scale, of the light on a plane like the marker's, and of the
// light on another plane. The part of the sky that the other plane sees is wrong by 20 %
// (light_posterior.h).
constexpr double kExposureError = 0.05, kLightError = 0.10, kTiltedLightError = 0.20;
// Cosine to the marker's normal from which a surface lies like the marker: within 14 degrees.
constexpr double kAsMarker = 0.97;
// Number of samples with an error of their own: neighbours share the pattern.
constexpr double kSamplesPerPattern = 16.0;
// Fresh snow, and soot.
constexpr double kMinReflectance = 0.01, kMaxReflectance = 0.95;

/// Reflectance of one sample, natural logarithms.
struct SampleColor {
  std::array<double, 3> log_rgb{};
  double brightness = 0.0;  // Their mean.
  bool in_sun = false;
  bool is_tilted = false;  // Against the marker: it has another part of the sky.
};

std::array<double, 3> Logs(LinearRgb color) {
  return {std::log(color.r), std::log(color.g), std::log(color.b)};
}

/// The samples of one model: those that the camera could read, evenly thinned.
struct SeenSamples {
  std::vector<const SurfaceSample*> usable;
  std::size_t seen = 0;
};

SeenSamples SamplesOf(const SurfaceSamples& samples, int placed_model) {
  SeenSamples found;
  for (const SurfaceSample& sample : samples.samples()) {
    if (sample.placed_model != placed_model) continue;
    ++found.seen;
    if (sample.frames > 0) found.usable.push_back(&sample);
  }
  return found;
}

std::vector<const SurfaceSample*> Thinned(const std::vector<const SurfaceSample*>& samples) {
  if (samples.size() <= kTraced) return samples;
  std::vector<const SurfaceSample*> thinned;
  thinned.reserve(kTraced);
  for (std::size_t i = 0; i < kTraced; ++i) {
    thinned.push_back(samples[(2 * i + 1) * samples.size() / (2 * kTraced)]);
  }
  return thinned;
}

/// Logarithm of the factor from brightness over irradiance to reflectance, per channel; nothing
/// where the marker has no light.
std::optional<std::array<double, 3>> LogUnit(const PhantomRays& phantoms,
                                             const LightOnSurfaces& light) {
  const SunlitIrradiance on_marker(phantoms, light.meter, light.day, light.marker_from_world,
                                   {1.0, 1.0, 1.0});
  const LinearRgb unit = (on_marker.sun_on_marker() + on_marker.ambient_on_marker()) *
                         std::numbers::pi / light.meter.light_on_marker() /
                         light.skies.marker_shade;
  const std::array<double, 3> logs = Logs(unit);
  if (!std::all_of(logs.begin(), logs.end(), [](double log) { return std::isfinite(log); })) {
    return std::nullopt;
  }
  return logs;
}

/// Reflectances of the samples whose light is certain.
std::vector<SampleColor> ColorsOf(const PhantomRays& phantoms,
                                  const std::vector<const SurfaceSample*>& samples,
                                  const LightOnSurfaces& light, const std::array<double, 3>& unit) {
  std::vector<FacingPoint> places;
  places.reserve(samples.size());
  for (const SurfaceSample* sample : samples) places.push_back({sample->point, sample->normal});
  const std::vector<LinearRgb> ambient =
      phantoms.Ambient(places, light.day, light.marker_from_world, kPathsPerSample);
  const Vec3 to_sun = light.marker_from_world * light.day.ToSun().xyz;
  const LinearRgb sun = light.day.SunNormalIrradiance();
  std::vector<SampleColor> colors;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const SurfaceSample& sample = *samples[i];
    const double cosine = std::max(0.0, Dot(sample.normal, to_sun));
    double visible = 0.0;
    if (cosine > 0.0 && Luminance(sun) > 0.0) {
      visible = phantoms.SunVisibility(sample.point, to_sun);
      if (visible > kPenumbraFrom && visible < kPenumbraTo) continue;
    }
    if (visible > 0.0 && light.skies.sun_transmittance) {
      const double share = light.skies.sun_transmittance->At(sample.point.xyz);
      if (share < kMinTransmittance) continue;
      visible *= share;
    }
    const std::array<double, 3> irradiance = Logs(ambient[i] + sun * (cosine * visible));
    SampleColor color;
    color.in_sun = visible > 0.0;
    color.is_tilted = sample.normal.z < kAsMarker;
    for (int c = 0; c < 3; ++c) {
      color.log_rgb[c] = sample.log_rgb[c] + unit[c] - irradiance[c];
      color.brightness += color.log_rgb[c] / 3.0;
    }
    if (std::isfinite(color.brightness)) colors.push_back(color);
  }
  return colors;
}

/// Middle and width of the shortest half of some values. Needs one value.
struct ShortestHalf {
  double middle = 0.0, width = 0.0;
};

ShortestHalf FindShortestHalf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  std::size_t best = 0;
  for (std::size_t i = 0; i + half < values.size(); ++i) {
    if (values[i + half] - values[i] < values[best + half] - values[best]) best = i;
  }
  return {0.5 * (values[best] + values[best + half]), values[best + half] - values[best]};
}

double MeanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Relative error of the mean of some samples. Those in the sun and those in shade tell how well
/// the light is known.
double ErrorOf(const std::vector<SampleColor>& colors) {
  std::vector<double> all, sunlit, shaded;
  for (const SampleColor& color : colors) {
    all.push_back(color.brightness);
    (color.in_sun ? sunlit : shaded).push_back(color.brightness);
  }
  const double mean = MeanOf(all);
  double variance = 0.0;
  for (const double value : all) variance += (value - mean) * (value - mean);
  variance /= static_cast<double>(all.size());
  const double own = std::sqrt(variance * kSamplesPerPattern / static_cast<double>(all.size()));
  const bool has_both = std::min(sunlit.size(), shaded.size()) >= kMinSamples;
  const double between = has_both ? 0.5 * std::fabs(MeanOf(sunlit) - MeanOf(shaded)) : 0.0;
  const auto tilted = static_cast<double>(std::count_if(
      colors.begin(), colors.end(), [](const SampleColor& color) { return color.is_tilted; }));
  const double light =
      kLightError + (kTiltedLightError - kLightError) * tilted / static_cast<double>(colors.size());
  return std::hypot(std::hypot(own, between), std::hypot(kExposureError, light));
}

SurfaceColor ColorOf(const std::vector<SampleColor>& colors) {
  SurfaceColor found;
  std::vector<double> brightness;
  brightness.reserve(colors.size());
  for (const SampleColor& color : colors) brightness.push_back(color.brightness);
  const ShortestHalf half = FindShortestHalf(std::move(brightness));
  if (half.width > kMaxHalf) {
    found.outcome = SurfaceColor::Outcome::kUneven;
    return found;
  }
  const double reach = std::max(kMinReach, kHalfWidths * 0.5 * half.width);
  std::vector<SampleColor> near;
  std::array<double, 3> sum{};
  for (const SampleColor& color : colors) {
    if (std::fabs(color.brightness - half.middle) > reach) continue;
    near.push_back(color);
    for (int c = 0; c < 3; ++c) sum[c] += std::exp(color.log_rgb[c]);
  }
  const auto count = static_cast<double>(near.size());
  const LinearRgb mean{sum[0] / count, sum[1] / count, sum[2] / count};
  if (Luminance(mean) < kMinReflectance || std::max({mean.r, mean.g, mean.b}) > kMaxReflectance) {
    found.outcome = SurfaceColor::Outcome::kImpossible;
    return found;
  }
  found.outcome = SurfaceColor::Outcome::kMeasured;
  found.reflectance = mean;
  found.relative_error = ErrorOf(near);
  found.places = static_cast<int>(near.size());
  return found;
}

SurfaceColor Measure(const PhantomRays& phantoms, const SeenSamples& seen,
                     const LightOnSurfaces& light,
                     const std::optional<std::array<double, 3>>& unit) {
  SurfaceColor none;
  if (!unit) {
    none.outcome = SurfaceColor::Outcome::kNoLight;
    return none;
  }
  if (seen.seen < kMinSamples) return none;
  if (static_cast<double>(seen.usable.size()) < kMinUsableShare * static_cast<double>(seen.seen)) {
    none.outcome = SurfaceColor::Outcome::kClipped;
    return none;
  }
  const std::vector<SampleColor> colors = ColorsOf(phantoms, Thinned(seen.usable), light, *unit);
  return colors.size() < kMinSamples ? none : ColorOf(colors);
}

}  // namespace

std::map<int, SurfaceColor> MeasureSurfaceColors(const PhantomRays& phantoms,
                                                 const SurfaceSamples& samples,
                                                 const LightOnSurfaces& light,
                                                 const std::set<int>& placed_models) {
  std::map<int, SurfaceColor> found;
  if (placed_models.empty()) return found;
  const auto unit = light.is_known ? LogUnit(phantoms, light) : std::nullopt;
  for (const int model : placed_models) {
    found[model] = Measure(phantoms, SamplesOf(samples, model), light, unit);
  }
  return found;
}

}  // namespace pleinair::compositor
