#pragma once

#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/surface_samples.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// One place where a phantom's own shadow should have an edge on one material.
struct ShadowEdge {
  LinearRgb contrast;        ///< Logarithm of lit over shaded, measured, a channel.
  double uncertainty = 0.0;  ///< Of its mean over the channels, one standard deviation.
  /// Light predicted by the model, on either side: the sky's own and what surfaces reflect of it;
  /// what they reflect of the sun; and, lit, the sun itself.
  LinearRgb sky_lit, sky_shaded, reflected_lit, reflected_shaded, sun;

  /// Contrast where the sky is `sky_radiance_scale` times as strong beside the sun as the model has
  /// it.
  LinearRgb Predicted(LinearRgb sky_radiance_scale) const;
};

/// The edges in view, of those that have the most surface samples on either side. `daylight` is the
/// model, `marker_from_world` with the heading already refined.
std::vector<ShadowEdge> FindShadowEdges(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                        const sky::SkyModel& daylight,
                                        const Mat3& marker_from_world);

/// What the edges say together.
struct SunSkyRatio {
  enum class Sun { kUnknown, kShines, kHidden };
  Sun sun = Sun::kUnknown;
  int edges = 0;                     ///< That could tell.
  int agreeing = 0;                  ///< That one and the same sun explains.
  double share_with_contrast = 0.0;  ///< By weight, those against the light subtracted.
  /// How much stronger than the model the sky is beside the sun; kShines alone.
  LinearRgb sky_radiance_scale{1.0, 1.0, 1.0};
  double log_uncertainty =
      0.0;  ///< Of the logarithm of sky_radiance_scale, one standard deviation.
};
SunSkyRatio EstimateSunSkyRatio(const std::vector<ShadowEdge>& edges);

}  // namespace pleinair::compositor
