#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/measured_sky.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/utc_time.h"
#include "compositor/composer.h"
#include "compositor/daylight_coefficients.h"
#include "compositor/light_meter.h"
#include "compositor/light_solver.h"
#include "compositor/surface_samples.h"
#include "devices/scene_description.h"
#include "sky/sky_model.h"
#include "sky/sun_position.h"

namespace pleinair::app {

/// What the report says of the light.
struct LightSummary {
  sky::SunPosition sun;
  double sun_normal_lux = 0.0;
  double sky_horizontal_lux = 0.0;
  LinearRgb gain;                ///< Display-linear value per cd/m².
  double gain_spread = 0.0;      ///< Relative; of the last frame that the marker could be read in.
  int readings = 0;              ///< Frames in which the marker served as a light meter.
  bool gain_is_guessed = false;  ///< No frame could be read and the scene gives no gain.
  MeasuredLight measured;        ///< Sun, sky and heading.
};

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
  static Result<std::unique_ptr<SceneRenderer>> Create(const CameraModel& camera,
                                                       const devices::SceneDescription& scene,
                                                       const compositor::ComposerOptions& options,
                                                       const LightOverrides& overrides = {});

  /// From now on the light among surfaces comes from daylight coefficients that are kept in a
  /// folder: slow once, then some milliseconds for any moment. Shows a bar while it computes.
  void KeepLightIn(const std::filesystem::path& folder) { light_cache_ = folder; }

  /// Which print the frames show, before the first is rendered: it is the light meter.
  void SetMarkerPrint(const compositor::MarkerPrint& print);

  /// Whether frames can tell more of the light than the scene and the user do.
  bool CanMeasureLight() const;

  /// Looks at a frame for the phantoms' own shadows, before the first is rendered. All the frames
  /// that are looked at share one sun: that of `time` of the first.
  void LookAtLight(ImageView<const std::uint8_t> rgb,
                   const Transform<Camera, Marker>& camera_from_marker, UtcTime time);

  /// Draws conclusions from the frames looked at: heading, sun and sky from now on.
  void SettleLight();

  /// Sun, sky and the light among surfaces at one moment.
  struct Light;

  /// Whether the sun has moved so far between two moments that the light should be made anew.
  bool NeedsLight(UtcTime made, UtcTime now) const;

  /// Works out the light of a moment; another thread may do so while frames are rendered, once the
  /// first has been or LightUp() was called.
  std::shared_ptr<const Light> PrepareLight(UtcTime time) const;

  /// Takes a light over; from then on Render() only moves the sun and leaves new light to others.
  Result<void> UseLight(std::shared_ptr<const Light> light);

  /// Makes the first light before the first frame is there, and UseLight() hold from now on.
  Result<void> LightUp(UtcTime time);

  /// The frame with the virtual objects as they stand at `time`.
  Result<RgbImage> Render(ImageView<const std::uint8_t> rgb,
                          const Transform<Camera, Marker>& camera_from_marker, UtcTime time);

  const LightSummary& light() const { return summary_; }
  const RenderTimes& times() const { return times_; }

 private:
  SceneRenderer(const CameraModel& camera, const devices::SceneDescription& scene);

  sky::SunPosition SunAt(UtcTime time) const;
  void OverrideLight(const sky::SunPosition& sun);
  void TraceLight();
  std::vector<compositor::LitMesh> LightAmongSurfaces(const sky::SkyModel& daylight,
                                                      const Mat3& marker_from_world) const;
  Result<void> TakeLight(std::shared_ptr<const Light> light);
  Result<void> UpdateLight(UtcTime time);
  void UpdateGain(ImageView<const std::uint8_t> rgb,
                  const Transform<Camera, Marker>& camera_from_marker);

  CameraModel camera_;
  devices::SceneDescription scene_;
  compositor::MarkerPrint print_;
  LightOverrides overrides_;
  std::shared_ptr<const sky::SkySource> skies_;  // Of the scene's day, for any place of the sun.
  LinearRgb sky_scale_{1.0, 1.0, 1.0};
  std::filesystem::path light_cache_;  // Empty: rays are traced for every place of the sun.
  std::optional<compositor::DaylightCoefficients> coefficients_;
  struct Look;  // What was seen of the light so far.
  std::unique_ptr<Look> look_;
  std::unique_ptr<compositor::LightSolver> solver_;
  std::unique_ptr<compositor::Composer> composer_;
  std::optional<compositor::LightMeter> meter_;
  std::shared_ptr<const Light> lit_;  // The light in use.
  bool light_from_outside_ = false;
  std::deque<LinearRgb> recent_gains_;  // Of the last frames, for the running median.
  LinearRgb guessed_gain_;
  LightSummary summary_;
  RenderTimes times_;
};

/// A scene's model, loaded and placed in marker coordinates. Errors as compositor::LoadModel.
Result<compositor::PlacedModel> PlaceModel(const devices::ModelReference& reference,
                                           bool is_phantom);

/// Marker coordinates from east-north-up, from the marker's stated heading (devices/
/// scene_description.h).
Mat3 MarkerFromWorld(const devices::MarkerDescription& marker);

}  // namespace pleinair::app
