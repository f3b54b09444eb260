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

/// Starts and ends recordings while a session runs. Thread-safe. Each recorder is created with the
/// first frame after Start(), and the recording starts at that frame's time.
class RecordingSwitch {
 public:
  struct Counts {
    std::int64_t recorded = 0, left_out = 0;
  };

  explicit RecordingSwitch(const CameraModel& camera) : camera_(camera) {}

  /// Creates the folder and records into it from the next frame on. Ends the current recording
  /// first. Errors: the folder holds a recording; it cannot be created.
  Result<void> Start(const std::filesystem::path& folder);
  /// Writes the queued frames and ends the recording. Without a frame, removes a folder that
  /// Start() created.
  void Stop();
  /// True while a recording was requested and has not failed.
  bool on() const;

  /// Records a frame if a recording was requested. `scene` is called when a recording begins.
  void Add(const std::shared_ptr<const devices::Frame>& frame, UtcTime moment,
           const std::function<scene::SceneDescription()>& scene);

  /// Totals of all recordings so far.
  Counts counts() const;
  /// The error that ended the last recording early.
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
