#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/error.h"
#include "devices/frame.h"
#include "devices/recordings/recording.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"
#include "session/pipeline.h"
#include "session/trajectory/follow_trajectory.h"
#include "session/trajectory/given_trajectory.h"

namespace pleinair::app {

/// Poses along the scene's trajectory, in a session that plays a recording. A thread aligns the
/// trajectory by at most 96 frames of the recording while the session runs. Until then the marker
/// alone gives poses, and always if the trajectory does not fit.
class LiveTrajectory {
 public:
  /// Opens the recording at its start.
  using Opener = std::function<Result<devices::Recording>()>;

  LiveTrajectory(session::TrajectoryRequest request, const scene::SceneDescription& scene,
                 Opener open);
  ~LiveTrajectory();

  /// Reports the place in the recording of the session's frame `index`, which comes next. Frames
  /// that are not reported have the index and the time of the recording. Thread-safe.
  void Played(std::int64_t index, const session::FrameTime& recorded);

  /// The pose of the camera in a frame: by the trajectory if it has one, else `by_marker`.
  /// Thread-safe.
  std::optional<session::CameraPose> PoseIn(const devices::Frame& frame,
                                            const std::optional<session::CameraPose>& by_marker);

  /// Waits until the trajectory is aligned, is found not to fit, or Ctrl-C is pressed.
  void Wait();

  /// Ends the alignment if it is under way: the marker alone gives poses from then on.
  void Stop();

  /// How the trajectory is aligned, or why it is not, once. Thread-safe.
  std::optional<std::string> TakeNews();

 private:
  struct Aligned {
    CameraModel camera;
    session::MarkerName marker;
    session::TrajectorySummary summary;
  };
  struct PlayedFrame {
    std::int64_t index;
    session::FrameTime recorded;
  };
  void Run();
  Result<Aligned> Align();
  session::FrameTime RecordedTimeOf(const devices::Frame& frame) const;

  session::TrajectoryRequest request_;  // Its clock and views are the thread's.
  const scene::SceneDescription scene_;
  const Opener open_;
  mutable std::mutex mutex_;
  bool stop_ = false;
  std::optional<std::string> news_;
  std::shared_ptr<const Aligned> aligned_;
  std::deque<PlayedFrame> played_;  // The last frames.
  std::thread thread_;
};

}  // namespace pleinair::app
