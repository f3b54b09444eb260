#pragma once

#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "sky/clouds/cloud_shadow.h"

namespace pleinair::clouds {

/// A box on the ground around the place: east, north, up, metres.
struct GroundBox {
  Vec3 low_m, high_m;
};

/// Sun transmittance of layers over a scene, as a projective map along the sun's rays. The value of
/// a ray holds for all points of the scene on it: SunTransmittance() changes little with height.
/// East, north, up in metres from the place. `across_x`, `across_y` and the direction to the sun
/// are a right-handed frame of unit vectors.
struct CloudShadowMap {
  Vec3 across_x, across_y;
  double first_x_m = 0.0, first_y_m = 0.0;  ///< Middle of the first texel along these axes.
  double texel_m = 0.0;
  int width = 0, height = 0;
  std::vector<float> share;  ///< Transmittance, 0…1; rows of rising y.

  double Mean() const;
  /// Bilinear between the middles of texels; the nearest border outside.
  double At(Vec3 point_m) const;
};

/// The map of a box, with texels of kShadowTexel_m, or larger ones where more than kMaxShadowSide a
/// side were needed. A sun below the horizon gives one texel of 0, no layers one of 1.
///
/// Each layer's optical depth is marched once on a grid across the rays. The mean over the sun's
/// disc then reads 64 places of each grid, as SunTransmittance() does.
inline constexpr double kShadowTexel_m = 5.0;
inline constexpr int kMaxShadowSide = 128;
CloudShadowMap MakeCloudShadowMap(const CloudFields& fields, const GroundBox& box,
                                  Direction<World> to_sun, double seconds);

}  // namespace pleinair::clouds
