#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <libcamera/request.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace pleinair::devices {

/// Queue of the requests that libcamera completed on its own thread, for the waiting thread.
class CompletedRequests {
 public:
  /// Thread-safe.
  void Add(libcamera::Request* request) {
    const std::lock_guard lock(mutex_);
    completed_.push_back(request);
    changed_.notify_all();
  }

  /// Ends a wait; thread-safe.
  void Wake() {
    const std::lock_guard lock(mutex_);
    wake_ = true;
    changed_.notify_all();
  }

  /// Waits for the next request. Returns nullopt if woken, a null pointer on timeout.
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
