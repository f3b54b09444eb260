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

/// Records frames into a folder of the project's own format, on a background thread. Frames that
/// the disk cannot take in time are dropped and counted. A full disk ends only the recording.
class LiveRecorder {
 public:
  /// Creates the folder with recording.json (calibration, start time, and what of
  /// scene.camera.recorded_lens holds for all frames) and scene.toml (the scene with
  /// `start` as its time). Errors: an existing recording, no permission, disk full.
  static Result<std::unique_ptr<LiveRecorder>> Create(const std::filesystem::path& folder,
                                                      const CameraModel& camera,
                                                      const scene::SceneDescription& scene,
                                                      UtcTime start);
  ~LiveRecorder();

  /// Queues a frame without blocking.
  void Add(std::shared_ptr<const devices::Frame> frame);

  /// Writes the queued frames and ends.
  void Finish();

  std::int64_t recorded() const;
  std::int64_t left_out() const;
  /// The error that ended the recording early.
  std::optional<Error> trouble() const;

 private:
  explicit LiveRecorder(std::unique_ptr<devices::FramePackWriter> writer);
  void Run();

  std::unique_ptr<devices::FramePackWriter> writer_;
  // Two seconds at 30 Hz: bridges pauses of the disk.
  BoundedQueue<std::shared_ptr<const devices::Frame>> queue_{60, WhenFull::kRefuse};
  mutable std::mutex mutex_;
  std::int64_t recorded_ = 0;
  std::optional<Error> trouble_;
  std::thread thread_;
};

/// Returns a scene as scene.toml with another time. Model paths are relative to `folder`.
std::string SceneToml(const scene::SceneDescription& scene, UtcTime start,
                      const std::filesystem::path& folder);

}  // namespace pleinair::app
