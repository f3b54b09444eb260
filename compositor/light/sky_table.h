#pragma once

#include <array>
#include <vector>

#include "base/vector.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Diffuse reflectance of the land beyond the phantoms: 0.2 is the customary value for mixed
/// ground.
inline constexpr double kLandAlbedo = 0.2;

/// Radiance of the distant surroundings by direction in marker coordinates, without the sun's disc.
/// The sky is tabulated once, because millions of rays query it. Below the horizon lies the land
/// that continues beyond the phantoms.
class SkyTable {
 public:
  /// `land_albedo`: diffuse reflectance of the land beyond the phantoms. That land is in full sun
  /// and under the whole sky.
  SkyTable(const sky::SkyModel& day, const Mat3& marker_from_world, double land_albedo);

  /// Radiance from a unit direction in marker coordinates: cd/m², linear Rec.709.
  std::array<float, 3> Radiance(Vec3 direction_in_marker) const;

  /// The part of the radiance from below the horizon that is reflected sunlight.
  const std::array<float, 3>& sunlight_from_land() const { return sunlight_from_land_; }

  /// Sine of the elevation of a direction in marker coordinates.
  double SineElevation(Vec3 direction_in_marker) const { return Dot(up_, direction_in_marker); }

 private:
  Mat3 world_from_marker_;
  Vec3 up_;  ///< Marker coordinates.
  std::array<float, 3> land_{}, sunlight_from_land_{};
  std::vector<std::array<float, 3>> nodes_;  ///< Hemi-octahedral map, row-major.
};

}  // namespace pleinair::compositor
