#pragma once

#include <optional>
#include <span>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// What white and black side by side on the marker show of the light there, display-linear.
struct MarkerPair {
  Point<Marker> place;
  LinearRgb step;      ///< White less black, which a veil leaves as it is; above 0.
  double black = 0.0;  ///< Sum of the channels.
};

/// A shadow's sharp edge across the marker.
struct MarkerShadowEdge {
  LinearRgb contrast;         ///< Logarithm of the light in the bright part over the dark one's.
  Point<Marker> lit, shaded;  ///< Middles of the two parts.
};

/// Looks for a shadow whose `depth`, as `contrast`, is at least about so much. Two levels of light
/// with hardly a pair between them, that change color as sun and sky do, and in which the black
/// follows the white, as under a thing that lies on the marker it does not; `black_share` is the
/// black's reflectance over that of the step. `pairs` are spread along the marker's edges.
std::optional<MarkerShadowEdge> FindMarkerShadowEdge(std::span<const MarkerPair> pairs,
                                                     LinearRgb depth, double black_share);

/// How strong the sky is beside the sun, from a shadow across the marker, whatever casts it;
/// `shadows`: one a frame that shows it. What casts it takes a part of the sky as well, so that it
/// is less certain than EstimateSunSkyRatio(), and says so. kUnknown where nothing can be read, as
/// with the sun grazing the marker. `daylight` is the model, `marker_from_world` with the heading
/// in use.
SunSkyRatio EstimateRatioFromMarkerShadow(const PhantomRays& phantoms,
                                          std::span<const MarkerShadowEdge> shadows,
                                          const sky::SkyModel& daylight,
                                          const Mat3& marker_from_world);

/// Below this cosine between the sun and the marker's normal, a small error of the heading is a
/// large one of the sun's light.
inline constexpr double kGrazingMarkerCosine = 0.2;

}  // namespace pleinair::compositor
