#include "compositor/plane_contrast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

using Rgb = std::array<double, 3>;

constexpr std::size_t kFewestSpots = 40;
// Where the model is asked, spread over the spots of a plane.
constexpr std::size_t kProbes = 12;
constexpr std::uint32_t kPaths = 128;

}  // namespace

double FindPlaneContrast(const LightSolver& solver, const SurfaceSamples& samples,
                         const sky::SkyModel& day, const Mat3& marker_from_world) {
  const auto& all = samples.samples();
  const Vec3 to_sun = marker_from_world * day.ToSun().xyz;
  std::map<std::pair<int, Rgb>, std::vector<std::uint32_t>> planes;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (all[i].frames == 0 || all[i].surface < 0) continue;
    const Vec3 n = all[i].normal;
    planes[{all[i].surface, {n.x, n.y, n.z}}].push_back(i);
  }
  std::map<int, std::pair<double, double>> range;  // By surface: least and most beside the model.
  for (const auto& [key, spots] : planes) {
    if (spots.size() < kFewestSpots) continue;
    std::vector<Point<Marker>> probes;
    for (std::size_t i = 0; i < kProbes; ++i) {
      probes.push_back(all[spots[(2 * i + 1) * spots.size() / (2 * kProbes)]].point);
    }
    const auto& [x, y, z] = key.second;
    const double sun = day.SunNormalIrradiance().g * std::max(0.0, Dot(Vec3{x, y, z}, to_sun));
    const auto ambient =
        solver.AmbientPhantomsOnly(probes, {x, y, z}, day, marker_from_world, kPaths);
    std::vector<double> modelled, seen;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const double open = sun > 0.0 ? solver.SunVisibilityPhantomsOnly(probes[i], to_sun) : 0.0;
      modelled.push_back(std::log(std::max(ambient[i].g + sun * open, 1e-9)));
    }
    for (const std::uint32_t spot : spots) seen.push_back(all[spot].log_rgb[1]);
    const double off = Median(seen) - Median(modelled);
    const auto [at, is_new] = range.try_emplace(key.first, off, off);
    at->second = {std::min(at->second.first, off), std::max(at->second.second, off)};
  }
  return std::accumulate(range.begin(), range.end(), 0.0, [](double most, const auto& surface) {
    return std::max(most, surface.second.second - surface.second.first);
  });
}

}  // namespace pleinair::compositor
