#include "compositor/photometry/marker/marker_surroundings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

// Of the board's width: how far around it counts, and how far beneath it the surface may lie.
constexpr double kAround = 0.5, kBeneath = 0.05;
constexpr double kFlush = 0.99;  // Cosine between the normals.
constexpr std::size_t kFewestSpots = 100;

}  // namespace

std::optional<BesidePrint> FindBesidePrint(const SurfaceSamples& samples,
                                           const std::vector<std::uint8_t>& reached) {
  const double board_m = samples.print().board_size_m;
  struct Surface {
    LinearRgb albedo;
    std::vector<double> brightness;
  };
  std::map<SurfacePlane, Surface> surfaces;
  for (std::size_t i = 0; i < samples.samples().size(); ++i) {
    const SurfaceSample& spot = samples.samples()[i];
    const Vec3 p = spot.point.xyz;
    const double beside_m = std::max(std::fabs(p.x), std::fabs(p.y)) - board_m / 2;
    if (reached[i] == 0 || spot.surface < 0 || spot.normal.z < kFlush ||
        std::fabs(p.z) > kBeneath * board_m || beside_m < 0.0 || beside_m > kAround * board_m)
      continue;
    Surface& surface = surfaces[PlaneOf(spot.surface, spot.normal)];
    surface.albedo = spot.albedo;
    surface.brightness.push_back((spot.log_rgb[0] + spot.log_rgb[1] + spot.log_rgb[2]) / 3);
  }
  const auto most = std::max_element(surfaces.begin(), surfaces.end(), [](auto& a, auto& b) {
    return a.second.brightness.size() < b.second.brightness.size();
  });
  if (most == surfaces.end() || most->second.brightness.size() < kFewestSpots) return std::nullopt;
  return BesidePrint{most->first, Quantile(most->second.brightness, 0.5), most->second.albedo};
}

}  // namespace pleinair::compositor
