#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>

#include "base/utc_time.h"

namespace pleinair::app {

/// Converts the frame time stamps of a live session into UTC and into time since the first frame.
/// Thread-safe.
class FrameClock {
 public:
  /// `start` is the UTC of the first frame. Without it, the clock time at the first frame's arrival
  /// is used.
  explicit FrameClock(std::optional<UtcTime> start) : start_(start) {}

  /// Adds the stamp of the next frame. Returns the milliseconds since the previous frame; nothing
  /// for the first.
  std::optional<double> Add(std::int64_t timestamp_ns) {
    const std::lock_guard lock(mutex_);
    const std::optional<std::int64_t> before_ns = last_stamp_ns_;
    last_stamp_ns_ = timestamp_ns;
    if (before_ns) return static_cast<double>(timestamp_ns - *before_ns) * 1e-6;
    first_stamp_ns_ = timestamp_ns;
    first_moment_ = start_.value_or(Now());
    return std::nullopt;
  }

  UtcTime MomentOf(std::int64_t timestamp_ns) const {
    const std::lock_guard lock(mutex_);
    return UtcTime(first_moment_.nanoseconds_since_1970() + timestamp_ns -
                   first_stamp_ns_.value_or(timestamp_ns));
  }

  std::int64_t SinceFirst_ns(std::int64_t timestamp_ns) const {
    const std::lock_guard lock(mutex_);
    return timestamp_ns - first_stamp_ns_.value_or(0);
  }

  /// UTC of the first frame; 1970 until it arrives.
  UtcTime first_moment() const {
    const std::lock_guard lock(mutex_);
    return first_moment_;
  }

  /// UTC of the machine's clock.
  static UtcTime Now() {
    return UtcTime(std::chrono::duration_cast<std::chrono::nanoseconds>(
                       std::chrono::system_clock::now().time_since_epoch())
                       .count());
  }

 private:
  mutable std::mutex mutex_;
  const std::optional<UtcTime> start_;
  std::optional<std::int64_t> first_stamp_ns_, last_stamp_ns_;
  UtcTime first_moment_;
};

}  // namespace pleinair::app
