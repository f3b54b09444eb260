#pragma once

#include <atomic>
#include <chrono>
#include <memory>

#include "devices/frame_source.h"

namespace pleinair::app {

/// Plays a recording as a camera would send it: each frame when its time has come, stamped on the
/// steady clock.
class PacedRecording : public devices::FrameSource {
 public:
  explicit PacedRecording(std::unique_ptr<devices::FrameSource> recording)
      : recording_(std::move(recording)) {}

  Result<std::optional<devices::Frame>> Next() override;
  std::optional<std::int64_t> FrameCount() const override { return recording_->FrameCount(); }

 private:
  std::unique_ptr<devices::FrameSource> recording_;
  std::optional<std::chrono::steady_clock::time_point> start_;
};

}  // namespace pleinair::app
