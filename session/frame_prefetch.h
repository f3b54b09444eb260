#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "base/bounded_queue.h"
#include "base/error.h"
#include "base/stage_times.h"
#include "devices/frame_source.h"

namespace pleinair::session {

/// Prefetches frames of a recording on a background thread.
class FramePrefetcher {
 public:
  explicit FramePrefetcher(std::unique_ptr<devices::FrameSource> source)
      : source_(std::move(source)), thread_([this] { Run(); }) {}
  ~FramePrefetcher() { Finish(); }
  FramePrefetcher(const FramePrefetcher&) = delete;
  FramePrefetcher& operator=(const FramePrefetcher&) = delete;

  std::optional<std::int64_t> FrameCount() const { return source_->FrameCount(); }

  /// As FrameSource::Next().
  Result<std::optional<devices::Frame>> Next() {
    auto next = read_.Take();
    if (!next) return std::optional<devices::Frame>();
    return *std::move(next);
  }

  /// Stops reading. Returns the stage times of reading.
  const StageTimes& Finish() {
    read_.Close();
    if (thread_.joinable()) thread_.join();
    return times_;
  }

 private:
  static constexpr std::size_t kAhead = 3;

  void Run() {
    for (bool more = true; more;) {
      auto frame = times_.Measure("read", [&] { return source_->Next(); });
      more = frame.has_value() && frame->has_value();
      if (!read_.Give(std::move(frame))) return;
    }
    read_.Close();
  }

  std::unique_ptr<devices::FrameSource> source_;
  StageTimes times_;  // Owned by the thread until it has ended.
  BoundedQueue<Result<std::optional<devices::Frame>>> read_{kAhead, WhenFull::kWait};
  std::thread thread_;  // Last: it uses the others.
};

}  // namespace pleinair::session
