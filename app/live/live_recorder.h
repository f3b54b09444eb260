#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "base/bounded_queue.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "devices/recordings/frame_pack.h"
#include "scene/scene_description.h"

namespace pleinair::app {

/// Records frames into a folder of the project's own form while they are shown, on a thread of its
/// own. What the disk cannot take in time is left out and counted; a full disk ends the recording
/// and nothing else.
class LiveRecorder {
 public:
  /// Makes the folder with recording.json (lens and moment) and scene.toml (the scene with `start`
  /// as its time). Errors: there is a recording already, no permission, disk full.
  static Result<std::unique_ptr<LiveRecorder>> Create(const std::filesystem::path& folder,
                                                      const CameraModel& camera,
                                                      const scene::SceneDescription& scene,
                                                      UtcTime start);
  ~LiveRecorder();

  /// Queues a frame; never waits.
  void Add(std::shared_ptr<const devices::Frame> frame);

  /// Writes what is queued and ends.
  void Finish();

  std::int64_t recorded() const;
  std::int64_t left_out() const;
  /// Why the recording ended before its time.
  std::optional<Error> trouble() const;

 private:
  explicit LiveRecorder(std::unique_ptr<devices::FramePackWriter> writer);
  void Run();

  std::unique_ptr<devices::FramePackWriter> writer_;
  // Two seconds at 30 Hz: what a disk may pause for.
  BoundedQueue<std::shared_ptr<const devices::Frame>> queue_{60, WhenFull::kRefuse};
  mutable std::mutex mutex_;
  std::int64_t recorded_ = 0;
  std::optional<Error> trouble_;
  std::thread thread_;
};

/// A scene as scene.toml with another time; models by their way from `folder`.
std::string SceneToml(const scene::SceneDescription& scene, UtcTime start,
                      const std::filesystem::path& folder);

}  // namespace pleinair::app
