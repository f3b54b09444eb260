#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/utc_time.h"
#include "compositor/composer.h"
#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/picture/occluder_mask.h"
#include "scene/scene_description.h"
#include "session/baked_lighting.h"
#include "session/camera_look_filter.h"
#include "session/exposure_meter.h"
#include "session/light_options.h"
#include "session/light_summary.h"
#include "session/render_times.h"
#include "session/scene_edit.h"
#include "session/scene_light.h"

namespace pleinair::session {

/// Everything that happens to a frame once the marker's pose is known: the day's light, the
/// camera's exposure from the marker, the composite. Keeps what it learns for the next frame.
class SceneRenderer {
 public:
  ~SceneRenderer();

  /// Loads the scene's models and prepares their light. Without virtual objects nothing is drawn
  /// and no OpenGL is needed.
  /// With a cache the light among surfaces comes from daylight coefficients that are kept there:
  /// slow once, then some milliseconds for any moment. `scene`: with what the light
  /// options give of it (WithGiven()).
  static Result<std::unique_ptr<SceneRenderer>> Create(const CameraModel& camera,
                                                       const scene::SceneDescription& scene,
                                                       const compositor::ComposerOptions& options,
                                                       const LightOptions& light = {});

  /// Whether coefficients were computed for the cache which could not be written there.
  bool FailedToKeepLight() const { return light_ && light_->FailedToKeep(); }

  /// Which print the frames show, before the first is rendered: it is the light meter. With light
  /// that is made elsewhere it counts from the next on.
  void SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance);

  /// Whether frames can tell more of the light than the scene and the user do: at least whether
  /// anything but phantoms shades the ground.
  bool CanMeasureLight() const;

  /// Looks at a frame for the phantoms' own shadows, before the first is rendered. All the frames
  /// that are looked at share one sun: that of `time` of the first.
  void ObserveLight(ImageView<const std::uint8_t> rgb,
                    const Transform<Camera, Marker>& camera_from_marker, UtcTime time);

  /// Draws conclusions from the frames looked at: heading, sun and sky from now on.
  void EstimateLight();

  /// The order for the light of a moment as the scene has it now. Not where there is nothing to
  /// draw.
  LightingRequest MakeLightingRequest(UtcTime time) const;

  /// The daylight coefficients of the scene: traced on the first call, or read from the cache.
  /// `progress` is called with the share of the work that is done, 0…1; it may be empty. Call only
  /// where the scene has virtual objects.
  std::shared_ptr<const compositor::DaylightCoefficients> Coefficients(
      const compositor::CoefficientProgress& progress);

  /// Makes the light of a moment that Render() would make for its first frame.
  Result<void> PrepareLight(UtcTime time);

  /// Takes a light over that was made elsewhere; from then on Render() only moves the sun and
  /// leaves new light to others.
  Result<void> UseLight(std::shared_ptr<const BakedLighting> light);

  /// Changes the scene: at once what is cheap (place, time, heading, drawing, where objects
  /// stand), with the next light the rest.
  Result<void> Edit(const SceneEdit& edit);

  /// Of the camera, as the scene has it.
  const CameraResponse& response() const { return response_; }

  /// Lets another thread draw from now on.
  void LetGo();

  /// Whether there is anything to draw.
  bool DrawsObjects() const { return composer_ != nullptr; }
  /// Samples a pixel that objects' edges have; nothing where there is nothing to draw.
  std::optional<int> samples() const {
    return composer_ ? std::optional(composer_->samples()) : std::nullopt;
  }
  /// Phantoms, then objects, as they stand.
  const std::vector<compositor::PlacedModel>& placed() const { return placed_; }

  /// The frame with the virtual objects as they stand at `time`. What covers the print, as `cover`
  /// has it, is before them.
  Result<RgbImage> Render(ImageView<const std::uint8_t> rgb,
                          const Transform<Camera, Marker>& camera_from_marker, UtcTime time,
                          const compositor::MarkerVisibility& cover = {});

  const LightSummary& light() const { return summary_; }
  /// Of the last Render().
  const RenderTimes& times() const { return times_; }

 private:
  /// What edits change besides the scene.
  struct Edited {
    double later_s = 0.0;  // Added to the moment of each frame.
    bool heading = false;  // Stated by an edit: measured ones no longer count.
  };

  SceneRenderer(const CameraModel& camera, const scene::SceneDescription& scene);

  Result<void> TakeLight(std::shared_ptr<const BakedLighting> light, bool made_elsewhere);
  void MoveObjects();
  Result<void> UpdateLight(UtcTime time);
  Result<void> UpdateCameraLook(ImageView<const std::uint8_t> rgb,
                                const Transform<Camera, Marker>& camera_from_marker);
  void UpdateExposureScale(ImageView<const std::uint8_t> rgb,
                           const Transform<Camera, Marker>& camera_from_marker);

  CameraModel camera_;
  CameraResponse response_;
  scene::SceneDescription scene_;
  scene::MarkerReflectance marker_reflectance_;
  std::vector<compositor::PlacedModel> placed_;
  // Nothing of these two where there is nothing to draw.
  std::optional<SceneLight> light_;
  std::unique_ptr<compositor::Composer> composer_;
  ExposureMeter exposure_;
  std::optional<CameraLookFilter> look_;  // Nothing: drawn pixels stay sharp and clean.
  Edited edited_;
  LightSummary summary_;
  RenderTimes times_;
};

/// A scene's model, loaded and placed in marker coordinates. Errors as compositor::LoadModel.
Result<compositor::PlacedModel> PlaceModel(const scene::ModelReference& reference, bool is_phantom);

}  // namespace pleinair::session
