#pragma once

#include <array>

#include "base/image.h"
#include "base/vector.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// What glossy objects mirror: the sky without the sun's disc, and one even radiance below the
/// horizon, blurred for `kLevels` roughnesses (level i: roughness i / (kLevels − 1)).
///
/// Longitude–latitude pictures in marker coordinates: column centre u ↔ azimuth angle
/// atan2(y, x) = 2π u − π, row centre v ↔ polar angle π v from +z. Three channels, the daylight's
/// unit.
struct EnvironmentMap {
  static constexpr int kWidth = 64, kHeight = 32, kLevels = 6;
  std::array<Image<float>, kLevels> levels;
};

/// Prefilters by importance sampling of the GGX distribution with view = normal = reflection
/// (Karis 2013, "Real Shading in Unreal Engine 4", split-sum approximation, first sum).
EnvironmentMap BuildEnvironmentMap(const sky::SkyModel& day, const Mat3& marker_from_world,
                                   LinearRgb ground_radiance);

}  // namespace pleinair::compositor
