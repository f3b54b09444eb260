#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/image.h"
#include "base/image_size.h"
#include "base/utc_time.h"
#include "compositor/composer_options.h"
#include "devices/frame.h"
#include "scene/scene_description.h"
#include "session/light_options.h"
#include "session/light_summary.h"
#include "session/marker_tracks.h"
#include "session/render_times.h"
#include "tracker/observation.h"
#include "tracker/tracker.h"
#include "tracker/unmeasured_markers.h"

namespace pleinair::session {

class MarkerRefiner;
class SceneRenderer;

struct PipelineOptions {
  compositor::ComposerOptions composer{};
  LightOptions light{};
  /// Of composed images; nothing: the frames' own. Markers are found at the frames' own size.
  std::optional<ImageSize> image_size{};
  /// Whether S-G markers are measured once more from all of their print's pixels (MarkerRefiner),
  /// which takes some 20 ms a marker.
  bool refine_markers = true;
  /// Observations of each marker that are kept, for sessions without an end; nothing: all.
  std::optional<std::size_t> kept_observations{};
};

/// A frame whose markers are found but not yet measured.
struct FoundFrame {
  devices::Frame frame;
  tracker::UnmeasuredMarkers markers;
  std::vector<tracker::LostMarker> lost;
  std::vector<std::string> warnings;
};

/// What the tracker found in a frame.
struct TrackedFrame {
  std::vector<tracker::MarkerObservation> observations;
  std::vector<tracker::LostMarker> lost;  ///< Of the frames before, not in this one.
  std::vector<std::string> warnings;      ///< What the user should know, such as mirrored prints.
};

/// Where the camera stands in a frame: the marker that the scene stands on, and how it was seen.
struct CameraPose {
  MarkerName marker;
  Observation observation;
};

/// A frame with the virtual objects in it.
struct ComposedFrame {
  std::optional<CameraPose> pose;     ///< Nothing: the marker was not seen.
  RgbImage image;                     ///< Without a pose the frame itself.
  std::optional<LightSummary> light;  ///< Nothing where nothing was drawn.
  RenderTimes times;
};

/// A frame goes in; the camera's pose, the light and the composed image come out. Replay, live
/// sessions and users' programs share it. Keeps what it learns for the next frame; frames come in
/// order.
///
/// Tracking (Find, Measure, Track, PoseIn, tracks) and composing (Compose, renderer) may run on two
/// threads beside each other; each by itself is for one thread at a time.
class Pipeline {
 public:
  /// Loads the scene's models. `camera`: of the frames. Errors: what the scene says of the marker,
  /// models that cannot be read, no OpenGL 4.5 where there is something to draw (system).
  static Result<std::unique_ptr<Pipeline>> Create(const CameraModel& camera,
                                                  const scene::SceneDescription& scene,
                                                  const PipelineOptions& options = {});
  ~Pipeline();

  /// Track(), PoseIn() and Compose() in one, at the scene's time plus the frame's time stamp. The
  /// light is as the scene describes it; session/recording_passes.h measures it in a recording's
  /// frames first. Errors as theirs.
  Result<ComposedFrame> Process(const devices::Frame& frame);

  /// Finds the markers of a frame, measures them and adds them to tracks(). Errors: a frame of
  /// another size than the camera's.
  Result<TrackedFrame> Track(const devices::Frame& frame);

  /// Track() in two parts, for who has several frames at hand: Find() leans on the frames before
  /// and takes one processor, Measure() takes several frames on all of them, with the same results.
  /// The two may run beside each other.
  Result<FoundFrame> Find(devices::Frame frame);
  std::vector<TrackedFrame> Measure(std::span<FoundFrame> found);

  /// The camera's pose in the frame that was tracked last; nothing where it does not show the
  /// marker that the scene stands on.
  std::optional<CameraPose> PoseIn(const devices::Frame& last_tracked) const;

  /// All that was seen of each marker so far.
  const MarkerTracks& tracks() const { return tracks_; }

  /// Takes the print of this marker for the light meter from now on; true where it was another
  /// before. Compose() does so for the marker of its pose.
  bool MeterLightOn(const MarkerName& marker);

  /// Brings a frame's colours to the size of composed images.
  void Resize(devices::Frame* frame) const;

  /// Draws the objects, as they are lit at `time`, into a frame of the size of composed images.
  /// Errors: no memory on the graphics card.
  Result<ComposedFrame> Compose(const devices::Frame& frame, const std::optional<CameraPose>& pose,
                                UtcTime time);

  /// The moment of a frame of a recording: the scene's time plus the frame's time stamp.
  UtcTime MomentOf(std::int64_t timestamp_ns) const;

  const scene::SceneDescription& scene() const { return scene_; }
  /// Of composed images.
  const CameraModel& output_camera() const { return output_camera_; }

  /// The stage that lights and draws.
  SceneRenderer& renderer() { return *renderer_; }

 private:
  Pipeline(const CameraModel& camera, const scene::SceneDescription& scene,
           const PipelineOptions& options);

  CameraModel camera_;
  CameraModel output_camera_;
  scene::SceneDescription scene_;
  bool hands_in_front_;
  std::optional<std::size_t> kept_observations_;
  std::unique_ptr<tracker::Tracker> tracker_;
  std::unique_ptr<MarkerRefiner> refiner_;  // Null where markers are not measured once more.
  MarkerTracks tracks_;
  std::unique_ptr<SceneRenderer> renderer_;
  std::optional<MarkerName> metered_marker_;  // Whose print the renderer takes for its light meter.
};

}  // namespace pleinair::session
