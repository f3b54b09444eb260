#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/utc_time.h"
#include "compositor/composer.h"
#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/light/light_solver.h"
#include "compositor/photometry/exposure_filter.h"
#include "compositor/photometry/light_estimator.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "compositor/photometry/sky_fit.h"
#include "compositor/photometry/sky_state.h"
#include "compositor/photometry/surface_samples.h"
#include "compositor/picture/camera_look.h"
#include "compositor/picture/occluder_mask.h"
#include "scene/scene_description.h"
#include "session/baked_lighting.h"
#include "session/light_options.h"
#include "session/scene_edit.h"
#include "sky/sky_model.h"
#include "sky/sun/sun_position.h"

namespace pleinair::session {

/// Light at which the report states noise, of the brightest: a sunlit grey.
inline constexpr double kMediumLight = 0.2;

/// What the report says of the light.
struct LightSummary {
  sky::SunPosition sun;
  double sun_normal_lux = 0.0;
  double sky_horizontal_lux = 0.0;
  /// Who says what the camera's exposure scale is; kGuess: no frame could be read and the scene
  /// gives none.
  enum class ExposureScaleSource { kMarker, kScene, kGuess };
  ExposureScaleSource exposure_scale_source = ExposureScaleSource::kMarker;
  LinearRgb exposure_scale;  ///< Display-linear value per cd/m².
  /// See ExposureFilter::Error(); of kMarker.
  LinearRgb exposure_scale_error;
  /// See ExposureFilter::Change().
  double exposure_scale_change = 1.0;
  int exposure_estimates = 0;  ///< Frames in which the marker served as a light meter.
  int dappled_estimates = 0;   ///< Of these, the ones in which leaves shade it.
  /// Share of the print that the phantoms leave in the sun, of the last estimate.
  double marker_sunlit_share = 0.0;
  /// Blur and grain of the last frames; nothing where they are not matched or cannot be read.
  std::optional<compositor::CameraLook> look;
  compositor::MeasuredLight measured;  ///< Sun, sky and heading.
};

/// Share of the readings in which leaves shade the print; 0 without any.
inline double DappledShare(const LightSummary& light) {
  return light.exposure_estimates > 0
             ? static_cast<double>(light.dappled_estimates) / light.exposure_estimates
             : 0.0;
}

/// Milliseconds spent in the last Render(), by stage.
struct RenderTimes {
  double light_ms = 0.0;    ///< Sun, sky, light among surfaces; nearly always 0.
  double meter_ms = 0.0;    ///< Reading the marker.
  double compose_ms = 0.0;  ///< Drawing and compositing.
};

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
  bool FailedToKeepLight() const { return coefficients_ && !coefficients_->kept; }

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
  const RenderTimes& times() const { return times_; }

 private:
  SceneRenderer(const CameraModel& camera, const scene::SceneDescription& scene);

  void OverrideLight(const sky::SunPosition& sun);
  Result<void> TakeLight(std::shared_ptr<const BakedLighting> light);
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
  LightOptions options_;  // Without a cache rays are traced for every place of the sun.
  compositor::SkyState skies_;
  std::shared_ptr<const compositor::DaylightCoefficients> coefficients_;
  std::unique_ptr<compositor::LightEstimator> estimator_;  // What was seen of the light so far.
  std::vector<compositor::PlacedModel> placed_;
  std::shared_ptr<const compositor::LightSolver> solver_;
  std::unique_ptr<compositor::Composer> composer_;
  std::optional<compositor::MarkerLightMeter> meter_;
  std::shared_ptr<const BakedLighting> lit_;  // The light in use.
  double later_s_ = 0.0;
  bool heading_is_edited_ = false;
  bool lock_exposure_ = false;
  bool light_from_outside_ = false;
  compositor::ExposureFilter exposure_filter_;
  LinearRgb guessed_exposure_scale_;
  int frames_to_camera_look_ = 0;  // Until the blur is measured again.
  std::deque<compositor::CameraLook> recent_camera_looks_;
  LightSummary summary_;
  RenderTimes times_;
};

/// A scene's model, loaded and placed in marker coordinates. Errors as compositor::LoadModel.
Result<compositor::PlacedModel> PlaceModel(const scene::ModelReference& reference, bool is_phantom);

}  // namespace pleinair::session
