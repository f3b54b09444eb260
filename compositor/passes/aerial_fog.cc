#include "compositor/passes/aerial_fog.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/check.h"

namespace pleinair::compositor {
namespace {

constexpr int kAzimuths = 12, kElevations = 3, kDistances = 13;
constexpr double kMaxElevation = 30.0 * std::numbers::pi / 180.0;
constexpr double kMinDistance_m = 4.0;  // Doubled from node to node: 16 km at the end.

glm::dvec3 ToDoubles(LinearRgb c) { return {c.r, c.g, c.b}; }

double DistanceOf(int node) { return kMinDistance_m * std::exp2(node); }

std::size_t NodeOf(int azimuth, int elevation, int distance) {
  return (static_cast<std::size_t>(azimuth % kAzimuths) * kElevations + elevation) * kDistances +
         distance;
}

}  // namespace

AerialFog::AerialFog(const sky::SkyModel& day, const Mat3& marker_from_world)
    : world_from_marker_(marker_from_world.Transposed()) {
  table_.reserve(std::size_t{kAzimuths} * kElevations * kDistances);
  for (int azimuth = 0; azimuth < kAzimuths; ++azimuth) {
    const double a = 2.0 * std::numbers::pi * azimuth / kAzimuths;
    for (int elevation = 0; elevation < kElevations; ++elevation) {
      const double e = kMaxElevation * (elevation - 1);
      const Direction<World> towards{
          {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)}};
      for (int distance = 0; distance < kDistances; ++distance) {
        const double metres = DistanceOf(distance);
        const sky::SkyModel::AirBetween air = day.AirTo(towards, Metres(metres));
        const glm::dvec3 transmittance =
            glm::clamp(ToDoubles(air.transmittance), glm::dvec3(1e-12), glm::dvec3(1.0));
        table_.push_back({-glm::log(transmittance) / metres, ToDoubles(air.inscattered) / metres});
      }
    }
  }
}

AerialFog::Air AerialFog::At(const glm::dvec3& towards, double distance_m) const {
  if (table_.empty()) return {};
  const Vec3 world = world_from_marker_ * Vec3{towards.x, towards.y, towards.z};
  const double azimuth =
      (std::atan2(world.x, world.y) / (2.0 * std::numbers::pi) + 1.0) * kAzimuths;
  const double elevation = std::clamp(
      std::asin(std::clamp(world.z, -1.0, 1.0)) / kMaxElevation + 1.0, 0.0, kElevations - 1.0);
  const double distance = std::clamp(
      std::log2(std::max(distance_m, kMinDistance_m) / kMinDistance_m), 0.0, kDistances - 1.0);
  const int a = static_cast<int>(azimuth);
  const int e = std::min(static_cast<int>(elevation), kElevations - 2);
  const int d = std::min(static_cast<int>(distance), kDistances - 2);
  Air sum;
  for (int corner = 0; corner < 8; ++corner) {
    const int da = corner & 1, de = corner >> 1 & 1, dd = corner >> 2;
    const double weight = std::abs(1.0 - da - (azimuth - a)) *
                          std::abs(1.0 - de - (elevation - e)) *
                          std::abs(1.0 - dd - (distance - d));
    const Air& node = table_[NodeOf(a + da, e + de, d + dd)];
    sum.extinction += weight * node.extinction;
    sum.inscattered += weight * node.inscattered;
  }
  return sum;
}

FogSplits AerialFog::Along(const glm::dvec3& towards, std::span<const double> splits,
                           std::span<const double> densities) const {
  CHECK_GE(splits.size(), std::size_t{2});
  CHECK_LE(splits.size(), std::size_t{FogSplits::kMax});
  CHECK_GE(densities.size() + 1, splits.size());
  FogSplits fog;
  double through_m = densities[0] * splits[0];
  for (std::size_t i = 0; i < FogSplits::kMax; ++i) {
    const std::size_t at = std::min(i, splits.size() - 1);
    if (i > 0 && i < splits.size()) through_m += densities[i - 1] * (splits[i] - splits[i - 1]);
    const Air air = At(towards, through_m);
    fog.distance_m[i] = static_cast<float>(splits[at]);
    fog.optical_depth[i] = through_m * air.extinction;
    fog.inscattered[i] = through_m * air.inscattered;
  }
  return fog;
}

glm::vec3 FogSplits::MaxLightPerMetre() const {
  glm::vec3 maximum(0.0F), light(0.0F), depth(0.0F);
  float distance = 0.0F;
  for (int i = 0; i < kMax; ++i) {
    // The light of a segment grows fastest at its start: x / (1 − e^−x) times its mean, 1 + x at
    // most.
    const glm::vec3 x = optical_depth[i] - depth;
    const glm::vec3 faster = glm::max(1.0F + x, glm::vec3(1.0F));
    const float length_m = distance_m[i] - distance;
    if (length_m > 0.0F) maximum = glm::max(maximum, faster * (inscattered[i] - light) / length_m);
    depth = optical_depth[i];
    light = inscattered[i];
    distance = distance_m[i];
  }
  return maximum;
}

}  // namespace pleinair::compositor
