#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

#include "base/error.h"

namespace pleinair::app {

/// Whether a live session must end, and the first error of its threads.
class SessionEnd {
 public:
  void Stop() { stop_ = true; }
  bool stopping() const { return stop_; }

  void Fail(Error error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
  }
  std::optional<Error> error() const {
    const std::lock_guard lock(mutex_);
    return error_;
  }

 private:
  std::atomic<bool> stop_ = false;
  mutable std::mutex mutex_;
  std::optional<Error> error_;
};

}  // namespace pleinair::app
