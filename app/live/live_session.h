#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "app/live/frame_clock.h"
#include "app/live/latency_histogram.h"
#include "app/live/live_counters.h"
#include "app/live/live_output.h"
#include "app/live/live_scene.h"
#include "app/live/live_statistics.h"
#include "app/live/live_trajectory.h"
#include "app/live/recording_switch.h"
#include "app/live/session_end.h"
#include "app/live/sighting_files.h"
#include "base/bounded_queue.h"
#include "base/camera_model.h"
#include "compositor/composer_options.h"
#include "compositor/models/placed_model.h"
#include "devices/frame_source.h"
#include "scene/scene_description.h"
#include "session/light_options.h"
#include "session/light_summary.h"
#include "session/pipeline.h"
#include "session/scene_renderer.h"

namespace pleinair::app {

struct LiveOptions {
  CameraModel camera;
  scene::SceneDescription scene;  ///< With the values that `light` provides (WithGiven()).
  compositor::ComposerOptions composer;
  session::LightOptions light;
  /// When the program began its work, for LiveStatistics::first_image_s.
  std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
  /// UTC of the first frame. Without it, the clock time at the first frame's arrival is used.
  std::optional<UtcTime> start;
  /// If true, every frame is tracked and drawn in order, however long it takes, and measured as in
  /// replay. If false, the newest frame is used and late ones are dropped.
  bool lossless = false;
  std::optional<std::filesystem::path> record;      ///< Folder of a new recording.
  std::optional<std::filesystem::path> detections;  ///< Observations, one line per frame.
  /// Poses and other trajectories, as in replay. Markers are then measured as in replay.
  std::optional<LiveOutput::Options> output;
  /// If true, another component shows the frames and calls Shown(). Latency then ends at that call.
  bool shown_elsewhere = false;
  /// The source beside its frames.
  struct Source {
    std::function<void()> stop{};                  ///< Ends its wait. Called from another thread.
    std::shared_ptr<LiveTrajectory> trajectory{};  ///< Null: the marker alone gives poses.
  } source{};
};

/// A composited frame.
struct DrawnFrame {
  std::shared_ptr<const devices::Frame> frame;
  std::optional<Transform<Camera, Marker>> camera_from_marker;
  RgbImage picture;  ///< With the virtual objects; the camera image where no marker is observed.
  UtcTime moment;    ///< Time of the frame, without SceneEdit::later_s.
  session::LightSummary light;
};

/// Captures, tracks, estimates light and records on separate threads, connected by bounded queues.
/// Drawing happens on the thread that created the session, or on another after LetGo(). No frame
/// waits for a slower stage, unless `lossless`.
class LiveSession {
 public:
  /// Receives warnings about the scene, for the user.
  using Loaded = std::function<void(const std::vector<std::string>& warnings)>;
  /// Loads the scene, starts the threads and prepares the first light. `loaded` is called between:
  /// when models and maps are loaded, and no file is made yet. Errors: models, maps, OpenGL, the
  /// marker, a recording or detections file that cannot be written.
  static Result<std::unique_ptr<LiveSession>> Create(std::unique_ptr<devices::FrameSource> source,
                                                     LiveOptions options,
                                                     const Loaded& loaded = {});
  ~LiveSession();

  /// Draws the newest tracked frame; nothing when there is none within `limit`. Errors: as the
  /// source, the tracker and drawing.
  Result<std::optional<DrawnFrame>> Draw(std::chrono::milliseconds limit);

  /// Releases the OpenGL context, so that another thread can draw.
  void LetGo() { pipeline_->renderer().LetGo(); }

  /// Phantoms, then objects, at their current poses. Not while another thread draws.
  const std::vector<compositor::PlacedModel>& placed() const {
    return pipeline_->renderer().placed();
  }

  /// True when the source has ended and every frame is drawn.
  bool finished() const { return tracked_.finished(); }

  /// Changes the scene from the next frame on. Its light follows when it is computed. Thread-safe.
  void Edit(const session::SceneEdit& edit);

  /// Reports that a drawn frame is on the screen now. `late_for_screen`: drawn frames replaced
  /// before display so far.
  void Shown(const DrawnFrame& frame, std::int64_t late_for_screen);

  /// Starts recording into a new folder. Thread-safe. Errors: the folder holds a recording.
  Result<void> StartRecording(const std::filesystem::path& folder) {
    return recording_.Start(folder);
  }
  void StopRecording() { recording_.Stop(); }
  bool recording() const { return recording_.on(); }

  /// Ends all threads. Queued frames are not drawn.
  void Stop();

  LiveStatistics statistics() const;
  /// Latencies of all frames drawn, or shown, since the last call.
  LatencyHistogram TakeLatencies() { return counters_.TakeLatencies(); }
  /// The error that ended recording early.
  std::optional<Error> recording_trouble() const { return recording_.trouble(); }
  /// True if the daylight coefficients could not be written to the cache.
  bool FailedToKeepLight() const;
  /// The error in writing detections or output, after the end of the session.
  const std::optional<Error>& output_trouble() const { return sightings_.trouble(); }

 private:
  using FramePtr = std::shared_ptr<const devices::Frame>;
  struct Tracked {
    FramePtr frame;
    std::optional<session::MarkerName> reference_marker;
    std::optional<session::CameraPose> pose;
  };

  LiveSession(std::unique_ptr<devices::FrameSource> source, LiveOptions options);
  Result<void> Prepare(const Loaded& loaded);
  void Capture();
  void Track();
  Result<void> CheckSize(const devices::Frame& frame) const;
  Result<Tracked> TrackOne(FramePtr frame);
  Result<std::optional<DrawnFrame>> DrawOne(Tracked tracked);

  LiveOptions options_;
  std::unique_ptr<devices::FrameSource> source_;
  std::unique_ptr<session::Pipeline> pipeline_;
  LiveScene scene_;  // Not edited in a lossless session.
  SightingFiles sightings_;
  RecordingSwitch recording_;
  BoundedQueue<FramePtr> captured_;
  BoundedQueue<Tracked> tracked_;
  FrameClock clock_;
  LiveCounters counters_;
  SessionEnd end_;
  std::vector<std::thread> threads_;
};

}  // namespace pleinair::app
