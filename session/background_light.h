#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "compositor/light/daylight/coefficient_worker.h"
#include "compositor/photometry/light_estimator.h"
#include "compositor/photometry/light_filter.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/sky_state.h"
#include "devices/frame_source.h"
#include "scene/scene_description.h"
#include "session/baked_lighting.h"
#include "session/light_options.h"
#include "session/scene_edit.h"

namespace pleinair::session {

/// Makes the light of a live session, on threads of its own and at low priority, so that no frame
/// waits for it: anew when the sun has moved, when the scene is edited, and when frames have told
/// of sun and sky. The first lights are traced with few rays; meanwhile daylight coefficients are
/// computed, from which each further light takes a fraction of a second. A moved object begins this
/// anew; until its next light is there it is drawn with the last. Then the frames are looked at for
/// the phantoms' shadows, as replay does, and again every minute; LightFilter has what they tell
/// together.
class BackgroundLight {
 public:
  struct Setup {
    CameraModel camera;
    scene::SceneDescription scene;
    std::vector<compositor::PlacedModel> placed;  ///< Phantoms, then objects.
    LightOptions light;
    SceneEdit edit;
    compositor::SkyState skies;  ///< As stated.
    UtcTime time;
    CameraResponse response = {};
  };

  /// Makes the first light and starts. Errors: the geometry.
  static Result<std::unique_ptr<BackgroundLight>> Create(Setup setup);
  ~BackgroundLight();

  /// These change what the next light is made for; any thread.
  void SetEdit(const SceneEdit& edit);
  void SetTime(UtcTime time);
  void SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance);

  /// Offers a frame to measure the light in; few are taken.
  void Show(std::shared_ptr<const devices::Frame> frame,
            const Transform<Camera, Marker>& camera_from_marker, UtcTime time);

  /// The newest light where it was not taken yet, otherwise null.
  std::shared_ptr<const BakedLighting> Take();

  /// How the work is going.
  struct Progress {
    compositor::MeasuredLight measured;
    double heading_deg = 0.0;     ///< Of the marker, in use.
    int frames_in_estimate = 0;   ///< Looked at since the last measurement; 0: none is under way.
    double coefficients = 0.0;    ///< 0…1: share of the daylight coefficients that is computed.
    bool failed_to_keep = false;  ///< Some could not be written to the cache.
  };
  Progress progress() const;

  void Stop();

 private:
  struct Wanted {
    SceneEdit edit;
    UtcTime time;
    scene::MarkerReflectance marker_reflectance;
    /// Of what a light is made for besides the sun's place.
    bool operator==(const Wanted& other) const;
  };
  struct Shown {
    std::shared_ptr<const devices::Frame> frame;
    Transform<Camera, Marker> camera_from_marker;
    UtcTime time;
  };

  explicit BackgroundLight(Setup setup);
  void Run();
  Result<void> Place(const std::vector<ObjectPlace>& objects);
  void Make(const Wanted& wanted);
  bool NeedsLight(const Wanted& wanted) const;
  void EstimateLight(const Shown& shown, const Wanted& wanted);
  void WantCoefficients(const Wanted& wanted, compositor::CoefficientWorker* worker);
  void TakeCoefficients(const compositor::CoefficientWorker& worker);
  LightingRequest LightingRequestFor(const Wanted& wanted);
  void UseOverriddenSky(UtcTime time, compositor::SkyState* skies) const;
  bool MayEstimate(const Wanted& wanted) const;

  /// The scene as it is solved now.
  struct PlacedScene {
    std::shared_ptr<const compositor::LightSolver> solver{};
    std::vector<ObjectPlace> objects{};
    std::shared_ptr<const compositor::DaylightCoefficients> coefficients{};
    double convergence = 0.0;  // Of the coefficients.
    std::shared_ptr<const compositor::LightSolver>
        ordered_for{};  // Whose coefficients are ordered.
  };
  /// What is known of heading and skies, by words, edits and frames.
  struct KnownLight {
    compositor::SkyState skies{};              // In use.
    std::optional<SceneEdit::Sky> skies_of{};  // The edit's air that they were made for.
    compositor::LightFilter filter{};          // Of the looks so far.
    compositor::SkyState found{};              // Its last conclusion, as the heading is.
    Radians heading{};
    std::unique_ptr<compositor::LightEstimator> estimator{};  // Of the look under way.
  };
  /// What the last light was made for.
  struct MadeLight {
    std::optional<Wanted> wanted;
    sky::SunPosition sun;
  };
  /// What the thread and its callers hand each other.
  struct Shared {
    bool stop = false;
    Wanted wanted{};
    std::optional<Shown> shown{};
    UtcTime next_estimate{};
    std::shared_ptr<const BakedLighting> newest{};
    Progress progress{};
  };

  Setup setup_;  // Its places of models follow the edits.
  std::thread thread_;

  // Of the thread alone.
  PlacedScene placed_;
  KnownLight known_;
  MadeLight made_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Shared shared_;  // Under the mutex.
};

}  // namespace pleinair::session
