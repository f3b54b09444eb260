#pragma once

// Internal: between the .cc files of this module; not installed.

#include <libcamera/request.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace pleinair::devices {

/// Requests that libcamera completed on its own thread, in their order, for the thread that waits.
class CompletedRequests {
 public:
  /// From any thread.
  void Add(libcamera::Request* request) {
    const std::lock_guard lock(mutex_);
    completed_.push_back(request);
    changed_.notify_all();
  }

  /// Ends a wait, from any thread.
  void Wake() {
    const std::lock_guard lock(mutex_);
    wake_ = true;
    changed_.notify_all();
  }

  /// Waits for the next one; nothing if it was woken, null when the time is over.
  std::optional<libcamera::Request*> TakeUntil(std::chrono::steady_clock::time_point end) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, end, [this] { return !completed_.empty() || wake_; });
    if (!completed_.empty()) {
      libcamera::Request* request = completed_.front();
      completed_.pop_front();
      return request;
    }
    if (std::exchange(wake_, false)) return std::nullopt;
    return nullptr;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<libcamera::Request*> completed_;
  bool wake_ = false;
};

}  // namespace pleinair::devices
