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
  scene::SceneDescription scene;  ///< With what `light` gives of it (WithGiven()).
  compositor::ComposerOptions composer;
  session::LightOptions light;
  /// UTC of the first frame; nothing: the clock's when it comes.
  std::optional<UtcTime> start;
  /// Every frame is tracked and drawn, in order, however long it takes, and measured as replay
  /// does; else the newest counts and late ones are left out.
  bool lossless = false;
  std::optional<std::filesystem::path> record;      ///< Folder of a new recording.
  std::optional<std::filesystem::path> detections;  ///< File for what was seen, a line a frame.
  /// Poses and more, as replay writes them. Prints are measured as in replay then.
  std::optional<LiveOutput::Options> output;
  /// Frames are shown elsewhere, which tells by Shown() when: latency counts until then.
  bool shown_elsewhere = false;
  /// Ends the source's waiting; called from another thread.
  std::function<void()> stop_source;
};

/// A frame as it is shown.
struct DrawnFrame {
  std::shared_ptr<const devices::Frame> frame;
  std::optional<Transform<Camera, Marker>> camera_from_marker;
  RgbImage picture;  ///< With the virtual objects; the camera's own where no marker is seen.
  UtcTime moment;    ///< Of the frame, with what an edit adds.
  session::LightSummary light;
};

/// Capturing, tracking, light and recording on threads of their own, handing frames on through
/// bounded queues; drawing happens on the thread that made the session, or another that it lets go
/// to. No frame ever waits for a slower stage (unless `lossless`).
class LiveSession {
 public:
  /// Loads the scene and prepares its first light. Errors: models, OpenGL, the marker, and a
  /// recording or detections that cannot be written.
  static Result<std::unique_ptr<LiveSession>> Create(std::unique_ptr<devices::FrameSource> source,
                                                     LiveOptions options);
  ~LiveSession();

  /// Draws the newest frame that was tracked; nothing when there is none within `limit`.
  /// Errors: the source's, the tracker's, drawing.
  Result<std::optional<DrawnFrame>> Draw(std::chrono::milliseconds limit);

  /// Lets another thread draw from now on.
  void LetGo() { pipeline_->renderer().LetGo(); }

  /// Phantoms, then objects, as they stand now. Not while another thread draws.
  const std::vector<compositor::PlacedModel>& placed() const {
    return pipeline_->renderer().placed();
  }

  /// The source is at its end and every frame has been drawn.
  bool finished() const { return tracked_.finished(); }

  /// Changes the scene from the next frame on; its light follows when it is made. Any thread.
  void Edit(const session::SceneEdit& edit);

  /// Notes that a drawn frame is on the screen now, and how many were replaced before so far.
  void Shown(const DrawnFrame& frame, std::int64_t late_for_screen);

  /// Starts recording into a new folder, or ends it. Any thread. Errors: it holds a recording.
  Result<void> StartRecording(const std::filesystem::path& folder) {
    return recording_.Start(folder);
  }
  void StopRecording() { recording_.Stop(); }
  bool recording() const { return recording_.on(); }

  /// Ends all threads; frames on their way are drawn no more.
  void Stop();

  LiveStatistics statistics() const;
  /// Of all frames drawn, or shown, since it was last asked.
  LatencyHistogram TakeLatencies() { return counters_.TakeLatencies(); }
  /// Why recording ended before its time.
  std::optional<Error> recording_trouble() const { return recording_.trouble(); }
  /// Whether daylight coefficients could not be written to their cache.
  bool FailedToKeepLight() const;
  /// After the end: why detections or the output could not be written.
  const std::optional<Error>& output_trouble() const { return sightings_.trouble(); }

 private:
  using FramePtr = std::shared_ptr<const devices::Frame>;
  struct Tracked {
    FramePtr frame;
    std::optional<session::MarkerName> reference_marker;
    std::optional<session::CameraPose> pose;
  };

  LiveSession(std::unique_ptr<devices::FrameSource> source, LiveOptions options);
  Result<void> Prepare();
  void Capture();
  void Track();
  Result<void> CheckSize(const devices::Frame& frame) const;
  Result<Tracked> TrackOne(FramePtr frame);
  Result<std::optional<DrawnFrame>> DrawOne(Tracked tracked);

  LiveOptions options_;
  std::unique_ptr<devices::FrameSource> source_;
  std::unique_ptr<session::Pipeline> pipeline_;
  LiveScene scene_;  // Not edited where frames are drawn without loss.
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
