#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
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
#include "compositor/photometry/surface_colors.h"
#include "devices/frame_source.h"
#include "scene/scene_description.h"
#include "session/baked_lighting.h"
#include "session/light_options.h"
#include "session/scene_edit.h"

namespace pleinair::session {

/// Computes the light of a live session in background threads at low priority, so that no frame
/// waits for it.
///
/// A new light is computed when the sun has moved, the scene was edited, or frames gave an estimate
/// of sun and sky. The first light is a draft with very few rays, so that the first frame need not
/// wait. The next ones are traced with few rays. Meanwhile daylight coefficients are computed; with
/// them each further light takes a fraction of a second. A moved object restarts this, and is drawn
/// with the last light until its next light is ready. A moved phantom changes with its next light,
/// a draft while it is dragged. Afterwards the phantoms' shadows in the frames are used to estimate
/// the light, as in replay, once a minute. LightFilter combines these estimates. The first that
/// shows the color of a described surface without one gives it; it stays for the session.
class BackgroundLight {
 public:
  struct Setup {
    CameraModel camera;
    scene::SceneDescription scene;
    std::vector<compositor::PlacedModel> placed;  ///< Phantoms, then objects.
    LightOptions light;
    SceneEdit edit;
    compositor::SkyState skies;  ///< By the scene description.
    UtcTime time;
    CameraResponse response = {};
    /// Light solver of the placed models; null: it is made.
    std::shared_ptr<const compositor::LightSolver> solver = {};
    scene::MarkerReflectance marker_reflectance = {};  ///< Size 0: not known yet.
  };

  /// Computes the draft and starts the thread. Errors: the geometry.
  static Result<std::unique_ptr<BackgroundLight>> Create(Setup setup);
  ~BackgroundLight();

  /// These change the inputs of the next light; any thread.
  void SetEdit(const SceneEdit& edit);
  void SetTime(UtcTime time);
  void SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance);

  /// Offers a frame for light estimation; only few are used.
  void Show(std::shared_ptr<const devices::Frame> frame,
            const Transform<Camera, Marker>& camera_from_marker, UtcTime time);

  /// Returns the newest light once, otherwise null.
  std::shared_ptr<const BakedLighting> Take();

  /// Progress of the background work.
  struct Progress {
    compositor::MeasuredLight measured;
    double heading_deg = 0.0;  ///< Heading of the marker in use.
    /// Frames added since the last estimate; 0: no estimate is under way.
    int frames_in_estimate = 0;
    double coefficients = 0.0;    ///< Computed share of the daylight coefficients, 0…1.
    bool failed_to_keep = false;  ///< Some coefficients could not be written to the cache.
  };
  Progress progress() const;

  void Stop();

 private:
  struct Wanted {
    SceneEdit edit;
    UtcTime time;
    scene::MarkerReflectance marker_reflectance;
    /// Compares the inputs of a light, except the sun's position.
    bool operator==(const Wanted& other) const;
  };
  struct Shown {
    std::shared_ptr<const devices::Frame> frame;
    Transform<Camera, Marker> camera_from_marker;
    UtcTime time;
  };

  explicit BackgroundLight(Setup setup);
  void Run();
  void PlaceIfPossible(Wanted* wanted);
  bool IsSuperseded(const Wanted& wanted) const;
  Result<void> Place(const SceneEdit& edit, bool replaces_surfaces);
  void UseColors(const std::map<int, compositor::SurfaceColor>& colors);
  void Make(const Wanted& wanted, std::shared_ptr<const compositor::LightSolver> solver);
  bool NeedsLight(const Wanted& wanted) const;
  void EstimateLight(const Shown& shown, const Wanted& wanted);
  void WantCoefficients(const Wanted& wanted, compositor::CoefficientWorker* worker);
  void TakeCoefficients(const compositor::CoefficientWorker& worker);
  LightingRequest LightingRequestFor(const Wanted& wanted,
                                     std::shared_ptr<const compositor::LightSolver> solver);
  void UseOverriddenSky(UtcTime time, compositor::SkyState* skies) const;
  bool MayEstimate(const Wanted& wanted) const;

  /// The scene of the current solver.
  struct PlacedScene {
    std::shared_ptr<const compositor::LightSolver> solver{};
    std::vector<ObjectPlace> objects{};
    std::vector<SurfacePlace> phantoms{};
    std::optional<SceneEdit> refused{};  // The last one, if its placements cannot be lit.
    std::shared_ptr<const compositor::DaylightCoefficients> coefficients{};
    double convergence = 0.0;  // Of the coefficients.
    bool has_measured_colors = false;
    std::shared_ptr<const compositor::LightSolver>
        ordered_for{};  // The solver whose coefficients are ordered.
  };
  /// Heading and skies by description, edits and frames.
  struct KnownLight {
    compositor::SkyState skies{};              // In use.
    std::optional<SceneEdit::Sky> skies_of{};  // The edit's air for which they were made.
    compositor::LightFilter filter{};          // Of all estimates so far.
    compositor::SkyState found{};              // Skies of the last estimate, as is the heading.
    clouds::CloudFields clouds{};              // The scene's.
    Radians heading{};
    std::unique_ptr<compositor::LightEstimator> estimator{};  // For the estimate under way.
  };
  /// Inputs of the last light.
  struct MadeLight {
    std::optional<Wanted> wanted;
    sky::SunPosition sun;
  };
  /// State that the thread and its callers share.
  struct Shared {
    bool stop = false;
    Wanted wanted{};
    std::optional<Shown> shown{};
    UtcTime next_estimate{};
    std::shared_ptr<const BakedLighting> newest{};
    Progress progress{};
  };

  Setup setup_;  // Its model positions follow the edits, its colors the frames.
  std::thread thread_;

  // Used by the thread alone.
  PlacedScene placed_;
  KnownLight known_;
  MadeLight made_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Shared shared_;  // Protected by the mutex.
};

}  // namespace pleinair::session
