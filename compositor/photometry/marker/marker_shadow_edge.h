#pragma once

#include <optional>
#include <span>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Display-linear measurement of white and black side by side on the marker.
struct MarkerPair {
  Point<Marker> place;
  LinearRgb step;      ///< White minus black, which veiling glare does not change; above 0.
  double black = 0.0;  ///< Sum of the channels.
};

/// A sharp shadow edge across the marker.
struct MarkerShadowEdge {
  LinearRgb contrast;  ///< Logarithm of the light in the bright part over that in the dark part.
  Point<Marker> lit, shaded;  ///< Middles of the two parts.
};

/// Finds a shadow whose contrast is at least about `depth`. The light must have two levels with
/// hardly a pair between them, and change color as sun and sky do. The black must change with the
/// white, which it does not under an object that covers the marker. `black_share` is the black's
/// reflectance over that of the step. `pairs` are spread along the marker's edges.
std::optional<MarkerShadowEdge> FindMarkerShadowEdge(std::span<const MarkerPair> pairs,
                                                     LinearRgb depth, double black_share);

/// Estimates the sky radiance scale beside the sun from a shadow across the marker, whatever casts
/// it. `shadows` has one entry per frame with a shadow. `daylight` is the model,
/// `marker_from_world` has the heading in use. The caster also occludes a part of the sky. The
/// reported uncertainty is therefore larger than that of EstimateSunSkyRatio(). Returns kUnknown
/// where no shadow can be measured, such as with the sun grazing the marker.
SunSkyRatio EstimateRatioFromMarkerShadow(const PhantomRays& phantoms,
                                          std::span<const MarkerShadowEdge> shadows,
                                          const sky::SkyModel& daylight,
                                          const Mat3& marker_from_world);

/// Cosine between the sun and the marker's normal. Below it, a small heading error becomes a large
/// error of the sun's light.
inline constexpr double kGrazingMarkerCosine = 0.2;

}  // namespace pleinair::compositor
