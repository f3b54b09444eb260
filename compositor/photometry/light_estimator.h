#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/image.h"
#include "compositor/photometry/light_filter.h"
#include "compositor/photometry/light_overrides.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "compositor/photometry/marker/marker_shadow_edge.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/shade/unmodelled_shadows.h"
#include "compositor/photometry/sky_fit.h"
#include "compositor/photometry/sky_state.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "compositor/photometry/surface_samples.h"
#include "scene/scene_description.h"

namespace pleinair::compositor {

/// What frames have told of the light.
struct LightEstimate {
  MeasuredLight measured;
  Radians heading;  ///< Of the marker.
  /// Null source: no frames have told yet, the scene's words hold.
  SkyState skies;
};

/// Reads heading, sun and sky from the shadows that phantoms cast in frames. All frames share one
/// sun: that of the first's time.
class LightEstimator {
 public:
  /// `scene`: with the stated or overriding heading.
  LightEstimator(std::shared_ptr<const PhantomRays> phantoms, const CameraModel& camera,
                 const scene::MarkerReflectance& marker_reflectance,
                 const scene::SceneDescription& scene, const LightOverrides& overrides,
                 UtcTime time, const CameraResponse& response);

  void Add(ImageView<const std::uint8_t> rgb, const Transform<Camera, Marker>& camera_from_marker);
  int frames() const { return samples_.frames(); }

  /// Draws the conclusions, as far as the overrides leave any. Takes a second or two. `memory`:
  /// of earlier looks in the same scene, whose readings count as well; gets this look's.
  LightEstimate Estimate(LightFilter* light_filter) const;

 private:
  /// The heading, with what it makes of the shadows' edges.
  SunSkyRatio EstimateHeadingAndRatio(LightFilter* light_filter, LightEstimate* found) const;
  void UseUnmodelledShadows(UnmodelledShadows unmodelled, LightEstimate* found) const;
  /// Whether a shadow's edge divides the print, not only in a frame now and then. Under words that
  /// have no sun the ground must show some such edge as well: a print may be wet or dirty.
  bool IsMarkerDivided(const UnmodelledShadows& unmodelled) const;
  void UseHeading(const LightFilter& light_filter, LightEstimate* found) const;
  /// Where nothing is to be measured: whether anything but phantoms shades the ground all the same.
  void UseDescribedLight(LightEstimate* found) const;

  std::shared_ptr<const PhantomRays> phantoms_;
  CameraModel camera_;
  scene::SceneDescription scene_;
  LightOverrides overrides_;
  UtcTime time_;
  sky::SunPosition sun_;
  std::unique_ptr<sky::SkyModel> day_;  // With a sun, whatever the scene says.
  SurfaceSamples samples_;
  MarkerLightMeter meter_;
  int dappled_ = 0;                                    // Frames in which leaves shade the print.
  std::vector<MarkerShadowEdge> marker_shadow_edges_;  // One a frame whose print is divided.
  LinearRgb exposure_scale_{1.0, 1.0, 1.0};            // Of the last frame that could be metered.
};

}  // namespace pleinair::compositor
