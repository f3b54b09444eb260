#pragma once

#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/surface_samples.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// A place where a phantom's shadow should have an edge on one material.
struct ShadowEdge {
  LinearRgb contrast;        ///< Measured logarithm of lit over shaded light, per channel.
  double uncertainty = 0.0;  ///< Standard deviation of its mean over the channels.
  /// Light that the model predicts on either side. `sky_*` is the sky's light and its reflections,
  /// `reflected_*` the sun's reflections, `sun` the direct sun on the lit side.
  LinearRgb sky_lit, sky_shaded, reflected_lit, reflected_shaded, sun;

  /// Predicted contrast if the sky is `sky_radiance_scale` times as strong beside the sun as in the
  /// model.
  LinearRgb Predicted(LinearRgb sky_radiance_scale) const;
};

/// Finds the shadow edges in view, at the cells with the most surface samples on either side.
/// `daylight` is the model, `marker_from_world` has the refined heading.
std::vector<ShadowEdge> FindShadowEdges(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                        const sky::SkyModel& daylight,
                                        const Mat3& marker_from_world);

/// Sun-to-sky ratio estimate from all edges.
struct SunSkyRatio {
  enum class Sun { kUnknown, kShines, kHidden };
  Sun sun = Sun::kUnknown;
  int edges = 0;     ///< Edges that could show a step.
  int agreeing = 0;  ///< Edges that one and the same sun explains.
  /// Weighted share of edges with contrast, minus those with reversed contrast.
  double share_with_contrast = 0.0;
  /// Radiance of the sky beside the sun, relative to the model. For kShines only.
  LinearRgb sky_radiance_scale{1.0, 1.0, 1.0};
  double log_uncertainty = 0.0;  ///< Standard deviation of the logarithm of sky_radiance_scale.
};
/// Least weighted share of edges with contrast under a sun, and least number of edges by which one
/// can be denied.
inline constexpr double kSunShare = 0.30;
inline constexpr int kMinEdgesForNoSun = 6;

SunSkyRatio EstimateSunSkyRatio(const std::vector<ShadowEdge>& edges);

}  // namespace pleinair::compositor
