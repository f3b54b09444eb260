#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/utc_time.h"
#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/light/light_solver.h"
#include "compositor/photometry/light_estimator.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/sky_state.h"
#include "scene/marker_reflectance.h"
#include "scene/scene_description.h"
#include "session/baked_lighting.h"
#include "session/light_options.h"
#include "sky/sun/sun_position.h"

namespace pleinair::session {

/// The daylight on one scene: its skies, as described or as frames show them, and the light among
/// surfaces that was last made or taken over.
class SceneLight {
 public:
  /// `options`: without a cache rays are traced for every place of the sun.
  SceneLight(std::shared_ptr<const compositor::LightSolver> solver,
             const scene::SceneDescription& scene, const LightOptions& options);

  /// Looks at a frame for the phantoms' own shadows. All frames looked at share one sun: that of
  /// `time` of the first. `scene` with the stated or overriding heading.
  void Observe(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
               const Transform<Camera, Marker>& camera_from_marker, UtcTime time,
               const scene::SceneDescription& scene,
               const scene::MarkerReflectance& marker_reflectance, const CameraResponse& response);

  /// Draws conclusions from the frames looked at, and goes on under the skies found; nothing where
  /// none was looked at.
  std::optional<compositor::LightEstimate> Conclude();

  /// Before the first light is made: the sky that the user states counts, and `measured` says so.
  void Override(const scene::SceneDescription& scene, const sky::SunPosition& sun,
                compositor::MeasuredLight* measured);

  /// The daylight coefficients of the scene: traced on the first call, or read from the cache.
  /// `progress` gets the share of the work that is done, 0…1; it may be empty.
  std::shared_ptr<const compositor::DaylightCoefficients> Coefficients(
      const scene::MarkerDescription& marker, const compositor::CoefficientProgress& progress);

  /// Whether coefficients were computed for the cache which could not be written there.
  bool FailedToKeep() const { return coefficients_ && !coefficients_->kept; }

  /// The order for the light of a moment.
  LightingRequest Request(UtcTime time, const scene::SceneDescription& scene,
                          const scene::MarkerReflectance& marker_reflectance,
                          const CameraResponse& response) const;

  /// Whether the light in use is none, or was made here for another place of the sun.
  bool IsStale(const sky::SunPosition& sun) const;

  /// Goes on with a light, made here (`made_elsewhere` false) or, from then on always, elsewhere.
  void Use(std::shared_ptr<const BakedLighting> light, bool made_elsewhere);

  /// Null before the first.
  const BakedLighting* in_use() const { return in_use_.get(); }
  bool made_elsewhere() const { return made_elsewhere_; }
  bool has_cache() const { return !options_.cache.empty(); }
  const compositor::SkyState& skies() const { return skies_; }
  const compositor::PhantomRays& phantoms() const { return solver_->phantoms(); }

 private:
  std::shared_ptr<const compositor::LightSolver> solver_;
  LightOptions options_;
  compositor::SkyState skies_;
  std::shared_ptr<const compositor::DaylightCoefficients> coefficients_;
  std::unique_ptr<compositor::LightEstimator> estimator_;  // What was seen of the light so far.
  std::shared_ptr<const BakedLighting> in_use_;
  bool made_elsewhere_ = false;
};

}  // namespace pleinair::session
