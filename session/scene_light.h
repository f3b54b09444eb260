#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/utc_time.h"
#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/light/light_solver.h"
#include "compositor/models/placed_model.h"
#include "compositor/photometry/light_estimator.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/sky_state.h"
#include "compositor/photometry/surface_colors.h"
#include "scene/marker_reflectance.h"
#include "scene/scene_description.h"
#include "session/baked_lighting.h"
#include "session/clouds/stated_light.h"
#include "session/light_fade.h"
#include "session/light_follower.h"
#include "session/light_options.h"
#include "sky/sun/sun_position.h"

namespace pleinair::session {

/// Indices of the described surfaces whose color is to be measured.
std::set<int> UncoloredSurfaces(const std::vector<scene::ModelReference>& phantoms);

/// How the light of a scene is traced.
compositor::LightSolverOptions SolverOptionsOf(const LightOptions& options);

/// Holds the daylight of one scene: its skies, described or estimated from frames, and the indirect
/// illumination in use.
class SceneLight {
 public:
  /// `options`: without a cache, rays are traced for every position of the sun.
  SceneLight(std::shared_ptr<const compositor::LightSolver> solver,
             const scene::SceneDescription& scene, const LightOptions& options);

  /// Adds a frame to the estimate of the light. All frames of an estimate share one position of the
  /// sun: that at `time` of the first. `scene` has the described or overriding heading.
  void Observe(CameraImageView image, const CameraModel& camera,
               const Transform<Camera, Marker>& camera_from_marker, UtcTime time,
               const scene::SceneDescription& scene,
               const scene::MarkerReflectance& marker_reflectance, const CameraResponse& response,
               bool shows_marker);

  /// What the added frames show.
  struct Conclusion {
    compositor::LightEstimate light;
    std::map<int, compositor::SurfaceColor> colors;  ///< By placed model.
  };

  /// Estimates the light from the frames added, and uses its skies from now on. Also measures the
  /// colors of `uncolored` placed models. Returns nothing if no frame was added.
  std::optional<Conclusion> Conclude(const std::set<int>& uncolored);

  /// Replaces the models by those of other colors. Light in use becomes stale. Errors: those of
  /// LightSolver::Create().
  Result<void> UseModels(const std::vector<compositor::PlacedModel>& placed);

  /// Adds a frame of the recording's first pass, in order, so that its light can be followed.
  /// `camera`: the lens of these frames.
  void Probe(CameraImageView image, const CameraModel& camera,
             const Transform<Camera, Marker>& camera_from_marker, std::int64_t frame_index,
             std::int64_t timestamp_ns, const scene::MarkerReflectance& marker_reflectance,
             const CameraResponse& response);

  /// Estimates how the light of the probed frames changes about that of the `reference` frames at
  /// `time`; without any, about that of the frames with the deepest shadows. Before Conclude() the
  /// described sun lights the scene, afterwards the estimated light.
  void Follow(const scene::SceneDescription& scene, UtcTime time,
              const std::set<std::int64_t>& reference);
  /// As LightFollower::EstimateResponse(); a found response decodes the probed frames from then on.
  /// Nothing if no frame was probed.
  std::optional<compositor::ResponseEstimate> EstimateResponse(
      const std::set<std::int64_t>& frames);
  /// Null if no frame was probed.
  const LightFollower* follower() const { return follower_ ? &*follower_ : nullptr; }

  /// Replaces the skies by those of the user's overrides, and reports this in `measured`. Call
  /// before the first illumination is computed.
  void Override(const scene::SceneDescription& scene, const sky::SunPosition& sun,
                compositor::MeasuredLight* measured);

  /// The daylight coefficients of the scene: traced on the first call, or read from the cache.
  /// `progress` receives the finished share of the work, 0…1; it may be empty.
  std::shared_ptr<const compositor::DaylightCoefficients> Coefficients(
      const scene::MarkerDescription& marker, const compositor::CoefficientProgress& progress);

  /// True if coefficients could not be written to the cache.
  bool FailedToKeep() const { return coefficients_ && !coefficients_->kept; }

  /// The input for computing the illumination at `time`.
  LightingRequest Request(UtcTime time, const scene::SceneDescription& scene,
                          const scene::MarkerReflectance& marker_reflectance,
                          const CameraResponse& response) const;

  /// True if no illumination is in use, or one that was computed here for another position of the
  /// sun.
  bool IsStale(const sky::SunPosition& sun) const;

  /// Uses this illumination from now on. Once one was `made_elsewhere`, none is computed here
  /// again. `fades`: the one in use may fade into it.
  void Use(std::shared_ptr<const BakedLighting> light, bool made_elsewhere, bool fades);

  /// The meshes of a frame at `time` while one illumination made elsewhere fades into the next;
  /// those of in_use() at the end of a fade. Null where they are already drawn. Valid until the
  /// next call, or Use().
  const std::vector<compositor::LitMesh>* FadedMeshes(UtcTime time);

  /// The light of a frame by the stated layers of clouds; nothing without them. Requires in_use().
  std::optional<StatedLight::OfFrame> StatedAt(UtcTime time, const sky::SunPosition& sun) {
    if (!clouds_.stated) return std::nullopt;
    return clouds_.stated->At(in_use_, time, sun);
  }

  /// The illumination in use; null before the first.
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
  std::unique_ptr<compositor::LightEstimator> estimator_;  // For the frames so far.
  bool concluded_ = false;
  /// Layers of clouds.
  struct {
    std::optional<StatedLight> stated;  // By LightChangeMode::kStated.
    clouds::CloudFields mirrored;       // In other modes they show in reflections.
  } clouds_;
  std::shared_ptr<const BakedLighting> in_use_;
  bool made_elsewhere_ = false;
  LightFade fade_;                         // Fades into light made elsewhere.
  std::optional<LightFollower> follower_;  // For the frames probed so far; queries probed_.
  std::shared_ptr<const compositor::LightSolver> probed_;
};

}  // namespace pleinair::session
