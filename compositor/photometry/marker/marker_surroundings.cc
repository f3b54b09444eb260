#include "compositor/photometry/marker/marker_surroundings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

// In units of board_size_m: maximum distance around the white margin, and maximum height difference
// of the surface.
constexpr double kAround = 0.5, kBeneath = 0.05;
constexpr double kFlush = 0.99;  // Cosine between the normals.
constexpr std::size_t kMinSurfaceSamples = 100;

}  // namespace

std::optional<MarkerSurroundings> FindMarkerSurroundings(
    const SurfaceSamples& samples, const std::vector<std::uint8_t>& sun_visible) {
  const double margin_size_m = samples.marker().board_size_m;
  struct Surface {
    LinearRgb albedo;
    std::vector<double> brightness;
  };
  std::map<SurfacePlane, Surface> surfaces;
  for (std::size_t i = 0; i < samples.samples().size(); ++i) {
    const SurfaceSample& surface_sample = samples.samples()[i];
    const Vec3 p = surface_sample.point.xyz;
    const double beside_m = std::max(std::fabs(p.x), std::fabs(p.y)) - margin_size_m / 2;
    if (sun_visible[i] == 0 || surface_sample.surface < 0 || surface_sample.normal.z < kFlush ||
        std::fabs(p.z) > kBeneath * margin_size_m || beside_m < 0.0 ||
        beside_m > kAround * margin_size_m)
      continue;
    Surface& surface = surfaces[PlaneOf(surface_sample.surface, surface_sample.normal)];
    surface.albedo = surface_sample.albedo;
    surface.brightness.push_back(
        (surface_sample.log_rgb[0] + surface_sample.log_rgb[1] + surface_sample.log_rgb[2]) / 3);
  }
  const auto maximum = std::max_element(surfaces.begin(), surfaces.end(), [](auto& a, auto& b) {
    return a.second.brightness.size() < b.second.brightness.size();
  });
  if (maximum == surfaces.end() || maximum->second.brightness.size() < kMinSurfaceSamples)
    return std::nullopt;
  return MarkerSurroundings{maximum->first, Quantile(maximum->second.brightness, 0.5),
                            maximum->second.albedo};
}

}  // namespace pleinair::compositor
