#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/utc_time.h"
#include "compositor/composer.h"
#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/picture/occluder_mask.h"
#include "scene/scene_description.h"
#include "session/baked_lighting.h"
#include "session/camera_look_filter.h"
#include "session/exposure_meter.h"
#include "session/frame_lens.h"
#include "session/ink/ground_ink.h"
#include "session/light_follower.h"
#include "session/light_options.h"
#include "session/light_summary.h"
#include "session/motion/frame_exposure.h"
#include "session/motion/pose_motion.h"
#include "session/render_times.h"
#include "session/scene_edit.h"
#include "session/scene_light.h"

namespace pleinair::session {

/// Renders a frame with a known marker pose: estimates light and exposure, and composes the image.
/// Keeps its estimates for the next frame.
class SceneRenderer {
 public:
  ~SceneRenderer();

  /// Loads the scene's models and prepares their light. Without virtual objects nothing is drawn
  /// and no OpenGL is needed. With a cache, the indirect illumination comes from stored daylight
  /// coefficients. These are slow to compute once, then give any moment's light in some
  /// milliseconds. `scene` must include the light options (WithGiven()).
  static Result<std::unique_ptr<SceneRenderer>> Create(const CameraModel& camera,
                                                       const scene::SceneDescription& scene,
                                                       const compositor::ComposerOptions& options,
                                                       const LightOptions& light = {});

  /// True if coefficients could not be written to the cache.
  bool FailedToKeepLight() const { return light_ && light_->FailedToKeep(); }

  /// Sets the marker that serves as light meter. Call before the first frame is rendered. With
  /// light that is computed elsewhere, it applies from the next light on.
  void SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance);

  /// True if frames can improve on the scene and the overrides. At the least they show whether
  /// unmodelled geometry shades the ground.
  bool CanMeasureLight() const;

  /// Adds a frame to the light estimate, before the first frame is rendered. All these frames share
  /// one sun position: that at `time` of the first. `shows_marker`: false where the marker is not
  /// seen in the frame.
  void ObserveLight(CameraImageView image, const Transform<Camera, Marker>& camera_from_marker,
                    UtcTime time, bool shows_marker = true);

  /// Adds a frame of the recording's first pass, in order, so that its light can be followed.
  /// `camera`: the lens of these frames.
  void ProbeLight(CameraImageView image, const CameraModel& camera,
                  const Transform<Camera, Marker>& camera_from_marker, std::int64_t frame_index,
                  std::int64_t timestamp_ns, const scene::MarkerReflectance& marker_reflectance);
  /// As SceneLight::Follow(), for all further frames.
  void FollowLight(UtcTime time, const std::set<std::int64_t>& reference);
  /// Estimates the camera's response from probed frames, after FollowLight(), and uses it from now
  /// on if the frames contradict sRGB strongly. A response of scene or options stays. Errors:
  /// no memory on the graphics card.
  Result<void> EstimateResponse(const std::set<std::int64_t>& frames);
  /// Null if no frame was probed.
  const LightFollower* light_follower() const { return light_ ? light_->follower() : nullptr; }

  /// Estimates heading, sun, sky and the colors of described surfaces that have none from the added
  /// frames, and uses them from now on. Errors: those of LightSolver::Create().
  Result<void> EstimateLight();

  /// Inputs of the light at `time` for the current scene. Call only if there are objects to draw.
  LightingRequest MakeLightingRequest(UtcTime time) const;

  /// The daylight coefficients of the scene: traced on the first call, or read from the cache.
  /// `progress` receives the finished share of the work, 0…1; it may be empty. Call only if the
  /// scene has virtual objects.
  std::shared_ptr<const compositor::DaylightCoefficients> Coefficients(
      const compositor::CoefficientProgress& progress);

  /// Computes the light that Render() would compute for its first frame.
  Result<void> PrepareLight(UtcTime time);

  /// Uses a light that was computed elsewhere. From then on Render() only moves the sun and
  /// computes no light. The light of the same surfaces fades into the next one.
  Result<void> UseLight(std::shared_ptr<const BakedLighting> light);

  /// Changes the scene. Location, time, heading, drawing options and object placement apply at
  /// once, the rest with the next light. Described surfaces are the rest, too: their shape is that
  /// of the light.
  Result<void> Edit(const SceneEdit& edit);

  /// Sets the ink on the phantoms, from the next frame on.
  void SetInk(InkSource source) { ink_.SetSource(std::move(source)); }

  /// The lens of the frames.
  const FrameLens& lens() const { return matched_.lens; }
  /// As FrameLens::UseMeasured(), before the first frame is rendered.
  void UseMeasuredLens(const compositor::FocusFit& fit, const std::vector<FrameTime>& frames);
  /// Uses the lens of a frame from now on.
  void UseLensOf(std::int64_t frame_index);

  /// For how long the frames are exposed.
  const FrameExposure& exposure() const { return matched_.exposure; }
  /// As FrameExposure::UseMeasured(), before the first frame is rendered.
  void UseMeasuredExposure(const compositor::ExposureFit& fit) {
    matched_.exposure.UseMeasured(fit);
  }
  /// Uses the exposure of a frame and the motion about its pose from now on. `own_exposure_s`: as
  /// its camera reports it.
  void UseMotion(std::int64_t frame_index, const PoseMotion& motion,
                 const std::optional<double>& own_exposure_s);

  /// Response of the camera: as in the scene, estimated, or sRGB.
  const CameraResponse& response() const { return camera_.response; }

  /// Releases the OpenGL context, so that another thread can draw.
  void LetGo();

  /// True if there are objects to draw.
  bool DrawsObjects() const { return composer_ != nullptr; }
  /// Samples per pixel at objects' edges; nothing if there are no objects to draw.
  std::optional<int> samples() const {
    return composer_ ? std::optional(composer_->samples()) : std::nullopt;
  }
  /// Phantoms, then objects, at their current placement.
  const std::vector<compositor::PlacedModel>& placed() const { return placed_; }
  /// Ray queries against the phantoms; null if there are no objects to draw.
  const compositor::PhantomRays* phantom_rays() const {
    return light_ ? &light_->phantoms() : nullptr;
  }

  /// Returns the frame with the virtual objects in the light of `time`. Objects that cover the
  /// marker, by `cover`, are in front of the virtual objects. `followed`: how the frame's light
  /// differs from the estimated one. `shows_marker`: false where the marker is not seen in the
  /// frame, so that exposure and camera look stay.
  Result<RgbImage> Render(CameraImageView image,
                          const Transform<Camera, Marker>& camera_from_marker, UtcTime time,
                          const compositor::MarkerVisibility& cover = {},
                          const FollowedLight& followed = {}, bool shows_marker = true);

  /// Updates all that Render() carries to later frames, and draws nothing. Later images have the
  /// same bytes as after Render().
  Result<void> Advance(CameraImageView image, const Transform<Camera, Marker>& camera_from_marker,
                       UtcTime time, const FollowedLight& followed = {}, bool shows_marker = true);

  const LightSummary& light() const { return summary_; }
  /// Times of the last Render() or Advance().
  const RenderTimes& times() const { return times_; }

 private:
  /// Changes by edits, apart from the scene.
  struct Edited {
    double later_s = 0.0;  // Added to the time of each frame.
    bool heading = false;  // An edit set the heading: estimated ones no longer apply.
    std::vector<ObjectPlace> first_places;  // Before any edit.
  };

  SceneRenderer(const CameraModel& camera, const scene::SceneDescription& scene);

  Result<void> TakeLight(std::shared_ptr<const BakedLighting> light, bool made_elsewhere);
  Result<void> UseColors(const std::map<int, compositor::SurfaceColor>& colors);
  Result<void> FadeLight(UtcTime time);
  void MoveObjects();
  Result<void> UpdateLight(UtcTime time);
  void SummarizeLight(const FollowedLight& followed);
  /// Brings light, animations, exposure and camera look to a frame.
  Result<void> Follow(CameraImageView image, const Transform<Camera, Marker>& camera_from_marker,
                      UtcTime time, FollowedLight followed, bool shows_marker);
  Result<void> UpdateCameraLook(CameraImageView image,
                                const Transform<Camera, Marker>& camera_from_marker);
  void UpdateExposureScale(CameraImageView image,
                           const std::optional<Transform<Camera, Marker>>& marker,
                           const FollowedLight& followed);

  struct {
    CameraModel model;
    CameraResponse response;
  } camera_;
  scene::SceneDescription scene_;
  scene::MarkerReflectance marker_reflectance_;
  std::vector<compositor::PlacedModel> placed_;
  // Both empty if there are no objects to draw.
  std::optional<SceneLight> light_;
  std::unique_ptr<compositor::Composer> composer_;
  GroundInk ink_;
  ExposureMeter exposure_;
  /// How drawn pixels are made to look like the camera's.
  struct {
    std::optional<CameraLookFilter> look;  // Empty: they stay sharp and clean.
    FrameLens lens;
    FrameExposure exposure;
    compositor::CameraMotion motion;  // In the frame; empty: at rest.
    int max_views = 1;
  } matched_;
  Edited edited_;
  LightSummary summary_;
  RenderTimes times_;
};

/// Loads a scene's model and places it in the coordinates of `marker`, upright if the model says
/// which way is up. Errors as compositor::LoadModel.
Result<compositor::PlacedModel> PlaceModel(const scene::ModelReference& reference, bool is_phantom,
                                           const scene::MarkerDescription& marker);

}  // namespace pleinair::session
