#pragma once

#include <array>
#include <vector>

#include "base/vector.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Diffuse reflectance of the land beyond the phantoms: 0.2 is the customary value for mixed
/// ground.
inline constexpr double kLandAlbedo = 0.2;

/// The radiance that comes to the scene from far away, by direction in marker coordinates: the
/// sky, tabulated once so that millions of rays can ask for it, and below the horizon the land
/// that goes on where the phantoms end. Without the sun's disc.
class SkyTable {
 public:
  /// `land_albedo`: diffuse reflectance of the land beyond the phantoms, which lies in full sun
  /// and under the whole sky.
  SkyTable(const sky::SkyModel& day, const Mat3& marker_from_world, double land_albedo);

  /// cd/m², linear Rec.709, from a unit direction in marker coordinates.
  std::array<float, 3> Radiance(Vec3 direction_in_marker) const;

  /// Sine of the elevation of a direction in marker coordinates.
  double SineElevation(Vec3 direction_in_marker) const { return Dot(up_, direction_in_marker); }

 private:
  Mat3 world_from_marker_;
  Vec3 up_;  ///< Marker coordinates.
  std::array<float, 3> land_{};
  std::vector<std::array<float, 3>> nodes_;  ///< Hemi-octahedral map, row-major.
};

}  // namespace pleinair::compositor
