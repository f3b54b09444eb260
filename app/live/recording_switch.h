#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "app/live/live_recorder.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "devices/frame.h"
#include "scene/scene_description.h"

namespace pleinair::app {

/// Starts and ends recordings while a session runs, on any thread. A recorder is made with the
/// first frame after one was asked for, whose moment is the recording's.
class RecordingSwitch {
 public:
  struct Counts {
    std::int64_t recorded = 0, left_out = 0;
  };

  explicit RecordingSwitch(const CameraModel& camera) : camera_(camera) {}

  /// Makes the folder and records into it from the next frame on; one that is under way is ended.
  /// Errors: it holds a recording, it cannot be made.
  Result<void> Start(const std::filesystem::path& folder);
  /// Writes what is queued and ends the recording; without a frame a folder that
  /// Start() made goes again.
  void Stop();
  /// One was asked for and goes on.
  bool on() const;

  /// Records a frame where that is asked for; `scene` is asked when a recording begins.
  void Add(const std::shared_ptr<const devices::Frame>& frame, UtcTime moment,
           const std::function<scene::SceneDescription()>& scene);

  /// Of all recordings so far.
  Counts counts() const;
  /// Why the last one ended before its time.
  std::optional<Error> trouble() const;

 private:
  const CameraModel camera_;
  mutable std::mutex mutex_;
  std::optional<std::filesystem::path> folder_;
  bool made_folder_ = false;
  std::shared_ptr<LiveRecorder> recorder_;
  std::optional<Error> trouble_;
  Counts of_ended_;
};

}  // namespace pleinair::app
