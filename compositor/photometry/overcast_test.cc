#include "compositor/photometry/overcast_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kMinSurfaceSamples = 40;
// Points per plane at which the model is evaluated, spread over its surface samples.
constexpr std::size_t kProbes = 12;
constexpr std::uint32_t kPaths = 128;

// Cosine between normals that count as one direction (30°).
constexpr double kOneDirection = 0.866;

/// Root mean square of the values about the mean of the lists' means. Each list has the same
/// weight.
double SpreadOf(const std::map<int, std::vector<double>>& values) {
  double sum = 0.0, square = 0.0;
  for (const auto& [surface, list] : values) {
    for (const double value : list) {
      sum += value / static_cast<double>(list.size());
      square += value * value / static_cast<double>(list.size());
    }
  }
  const double mean = sum / static_cast<double>(values.size());
  return std::sqrt(std::max(0.0, square / static_cast<double>(values.size()) - mean * mean));
}

}  // namespace

OvercastTest TestForOvercast(const PhantomRays& phantoms, const SurfaceSamples& samples,
                             const sky::SkyModel& day, const Mat3& marker_from_world) {
  const auto& all = samples.samples();
  const Vec3 to_sun = marker_from_world * day.ToSun().xyz;
  std::map<SurfacePlane, std::vector<std::uint32_t>> planes;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (all[i].frames > 0) planes[PlaneOf(all[i].surface, all[i].normal)].push_back(i);
  }
  OvercastTest contrast;
  // Brightness of each surface's planes relative to the model.
  std::map<int, std::vector<double>> off;
  std::map<int, std::vector<double>> off_all;  // The same, also relative to the described colors.
  std::vector<Vec3> directions;
  for (const auto& [plane, surface_samples] : planes) {
    if (surface_samples.size() < kMinSurfaceSamples) continue;
    const SurfaceSample& first = all[surface_samples.front()];
    std::vector<Point<Marker>> probes;
    for (std::size_t i = 0; i < kProbes; ++i) {
      probes.push_back(
          all[surface_samples[(2 * i + 1) * surface_samples.size() / (2 * kProbes)]].point);
    }
    const double sun = day.SunNormalIrradiance().g * std::max(0.0, Dot(first.normal, to_sun));
    const auto ambient = phantoms.Ambient(probes, first.normal, day, marker_from_world, kPaths);
    std::vector<double> modelled, seen;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const double open = sun > 0.0 ? phantoms.SunVisibility(probes[i], to_sun) : 0.0;
      modelled.push_back(std::log(std::max(ambient[i].g + sun * open, 1e-9)));
    }
    for (const std::uint32_t surface_sample : surface_samples)
      seen.push_back(all[surface_sample].log_rgb[1]);
    const double beside = Median(seen) - Median(modelled);
    if (first.surface >= 0) off[first.surface].push_back(beside);
    if (first.albedo.g <= 0.0) continue;
    off_all[plane.first].push_back(beside - std::log(first.albedo.g));
    if (std::none_of(directions.begin(), directions.end(),
                     [&](Vec3 other) { return Dot(other, first.normal) > kOneDirection; })) {
      directions.push_back(first.normal);
    }
  }
  for (const auto& [surface, values] : off) {
    const auto [minimum, maximum] = std::minmax_element(values.begin(), values.end());
    contrast.within = std::max(contrast.within, *maximum - *minimum);
  }
  contrast.surfaces = static_cast<int>(off_all.size());
  contrast.directions = static_cast<int>(directions.size());
  if (!off_all.empty()) contrast.among = SpreadOf(off_all);
  return contrast;
}

}  // namespace pleinair::compositor
