#pragma once

#include <functional>
#include <optional>

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/heading_from_shadows.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// Where the scene puts the sun, in the marker's frame.
struct StatedSun {
  Vec3 up;
  Vec3 to_sun;  ///< At the described time.
  /// At so many seconds later, negative: earlier. It may be below the horizon.
  std::function<Vec3(double)> to_sun_after;
};

/// True if the estimate leaves so little unexplained that no sun elsewhere explains twice as much.
inline bool IsConvincing(const HeadingEstimate& estimate) {
  constexpr double kShare = 0.4;
  return estimate.explained_share >= kShare;
}

/// Searches for a sun that explains the shadows far better than any heading within
/// kMaxHeadingError_deg of the described one. It searches the whole circle at the described time,
/// and the sun's path within six hours of it. The sun must explain twice as much, and more by four
/// standard errors. Headings that put it within 4 degrees must explain less. Its mean step of the
/// logarithm of light must be 0.35 or more. Takes as many rays as eight EstimateHeading().
std::optional<SunElsewhere> FindSunElsewhere(const PhantomRays& phantoms,
                                             const SurfaceSamples& samples, const StatedSun& sun);

}  // namespace pleinair::compositor
