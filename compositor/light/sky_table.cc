#include "compositor/light/sky_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::compositor {
namespace {

// Nodes per side of the hemi-octahedral map. Neighbours are about 0.7° apart, which resolves the
// bright region around the sun. The error of the horizontal irradiance stays below 0.1 %.
constexpr int kSide = 193;

std::array<float, 3> ToFloats(LinearRgb c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

}  // namespace

SkyTable::SkyTable(const sky::SkyModel& day, const Mat3& marker_from_world, double land_albedo)
    : world_from_marker_(marker_from_world.Transposed()),
      up_(marker_from_world * Vec3{0.0, 0.0, 1.0}),
      nodes_(static_cast<std::size_t>(kSide) * kSide) {
  const double sine_sun = std::max(0.0, day.ToSun().xyz.z);
  const LinearRgb level_sun = day.SunNormalIrradiance() * sine_sun;
  land_ = ToFloats((level_sun + day.SkyHorizontalIrradiance()) * (land_albedo / std::numbers::pi));
  sunlight_from_land_ = ToFloats(level_sun * (land_albedo / std::numbers::pi));
  // Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors",
  // hemi-oct: the upper hemisphere's octahedron, rotated by 45° to fill the square.
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double s = 2.0 * column / (kSide - 1) - 1.0;
      const double t = 2.0 * row / (kSide - 1) - 1.0;
      const double x = (s + t) / 2.0;
      const double y = (s - t) / 2.0;
      // The border is the horizon itself, where a sky may already be defined as dark.
      const double z = std::max(1e-4, 1.0 - std::fabs(x) - std::fabs(y));
      nodes_[static_cast<std::size_t>(row) * kSide + column] =
          ToFloats(day.SkyRadiance({Normalized({x, y, z})}));
    }
  }
}

std::array<float, 3> SkyTable::Radiance(Vec3 direction_in_marker) const {
  const Vec3 d = world_from_marker_ * direction_in_marker;
  if (d.z <= 0.0) return land_;
  const double scale = 1.0 / (std::fabs(d.x) + std::fabs(d.y) + d.z);
  const double x = d.x * scale;
  const double y = d.y * scale;
  const double column = std::clamp((x + y + 1.0) / 2.0, 0.0, 1.0) * (kSide - 1);
  const double row = std::clamp((x - y + 1.0) / 2.0, 0.0, 1.0) * (kSide - 1);
  const int c = std::min(static_cast<int>(column), kSide - 2);
  const int r = std::min(static_cast<int>(row), kSide - 2);
  const auto fc = static_cast<float>(column - c);
  const auto fr = static_cast<float>(row - r);
  const std::array<float, 3>* node = &nodes_[static_cast<std::size_t>(r) * kSide + c];
  std::array<float, 3> radiance;
  for (int i = 0; i < 3; ++i) {
    const float upper = node[0][i] + (node[1][i] - node[0][i]) * fc;
    const float lower = node[kSide][i] + (node[kSide + 1][i] - node[kSide][i]) * fc;
    radiance[i] = upper + (lower - upper) * fr;
  }
  return radiance;
}

}  // namespace pleinair::compositor
