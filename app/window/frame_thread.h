#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/live/live_session.h"
#include "base/bounded_queue.h"

namespace pleinair::app {

/// Draws a session's frames on a background thread and keeps the newest for a window.
class FrameThread {
 public:
  explicit FrameThread(LiveSession& session);
  ~FrameThread();

  /// Returns the newest frame that was not taken yet.
  std::optional<DrawnFrame> Take();
  /// Number of frames replaced by a newer one before they were taken.
  std::int64_t late() const { return frames_.dropped(); }
  /// True after the session's end or error.
  bool ended() const { return ended_; }
  std::optional<Error> error() const;

  void Stop();

 private:
  void Run();

  LiveSession& session_;
  BoundedQueue<DrawnFrame> frames_{1, WhenFull::kReplaceOldest};
  std::atomic<bool> stop_ = false, ended_ = false;
  mutable std::mutex mutex_;
  std::optional<Error> error_;
  std::thread thread_;
};

}  // namespace pleinair::app
