#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <optional>

#include "base/vector.h"
#include "sky/clouds/cloud_field.h"
#include "sky/clouds/higher_orders.h"

namespace pleinair::clouds {

/// A ray through a layer, with the sunlight that the layer scatters along it.
struct LayerRay {
  double depth = 0.0;           ///< Optical depth of the whole ray.
  std::optional<Vec3> cloud_m;  ///< Where the ray first meets cloud.
  /// Radiance over the sun's normal irradiance, per steradian, without what lies before the layer.
  double first = 0.0;   ///< Scattered once.
  double higher = 0.0;  ///< By HigherOrders.
};

/// Marches a ray from `from_m` along `view`, a unit vector that rises. `to_sun`: unit vector.
/// Without `lit` there is no sunlight.
LayerRay MarchLayer(const CloudField& field, const HigherOrders& higher, Vec3 from_m, Vec3 view,
                    Vec3 to_sun, bool lit, double seconds);

/// Factor on HigherOrders that gives the layer's scattered sunlight a mean over its area.
///
/// HigherOrders conserves the energy of homogeneous columns. Cumulus columns also lose light
/// through their sides. The factor is (E − E₁) / E_h: `diffuse_down` is E, the diffuse illuminance
/// below the layer over E_sun; E₁ and E_h are means of what MarchLayer() scatters downwards, once
/// and more often. Takes 2 × 4096 rays.
double MeanHigherScale(const CloudField& field, const HigherOrders& higher, Vec3 to_sun,
                       double diffuse_down);

}  // namespace pleinair::clouds
