#pragma once

#include <array>

#include "base/image.h"
#include "base/vector.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Prefiltered environment for glossy reflections: the sky without the sun's disc, and one uniform
/// radiance below the horizon. It is blurred for `kLevels` roughnesses (level i: roughness i /
/// (kLevels − 1)).
///
/// Images are longitude–latitude maps in marker coordinates. Column centre u ↔ azimuth angle
/// atan2(y, x) = 2π u − π, row centre v ↔ polar angle π v from +z. The three channels have the
/// daylight's unit.
struct EnvironmentMap {
  static constexpr int kWidth = 64, kHeight = 32, kLevels = 6;
  std::array<Image<float>, kLevels> levels;
};

/// Prefilters by importance sampling of the GGX distribution with view = normal = reflection
/// (Karis 2013, "Real Shading in Unreal Engine 4", split-sum approximation, first sum).
EnvironmentMap BuildEnvironmentMap(const sky::SkyModel& day, const Mat3& marker_from_world,
                                   LinearRgb ground_radiance);

}  // namespace pleinair::compositor
