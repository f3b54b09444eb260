#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "devices/frame_source.h"

namespace pleinair::app {

/// Plays a recording like a camera: it delivers each frame when it is due, stamped by the steady
/// clock. If reading is too slow, it plays at a lower rate.
class PacedRecording : public devices::FrameSource {
 public:
  struct Options {
    std::optional<double> rate_hz;  ///< Instead of the recording's own rate.
    bool loop = false;              ///< Restarts at the end, forever.
    /// Receives the index that the next frame gets, and the frame as recorded; may be empty.
    std::function<void(std::int64_t index, const devices::Frame& recorded)> played{};
  };
  /// Opens the recording at its start. Called again for each loop.
  using Opener = std::function<Result<std::unique_ptr<devices::FrameSource>>()>;

  static Result<std::unique_ptr<PacedRecording>> Open(Opener opener, const Options& options);

  Result<std::optional<devices::Frame>> Next() override;
  std::optional<std::int64_t> FrameCount() const override;

 private:
  PacedRecording(Opener opener, const Options& options,
                 std::unique_ptr<devices::FrameSource> recording)
      : opener_(std::move(opener)), options_(options), recording_(std::move(recording)) {}

  Opener opener_;
  Options options_;
  std::unique_ptr<devices::FrameSource> recording_;
  std::optional<std::chrono::steady_clock::time_point> start_;
  std::int64_t next_index_ = 0;
  std::int64_t round_ns_ = 0;  // Stamp of the loop's first frame.
  std::int64_t last_ns_ = 0, last_step_ns_ = 1'000'000'000 / 30;
};

}  // namespace pleinair::app
