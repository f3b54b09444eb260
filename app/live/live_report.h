#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "app/live/live_session.h"

namespace pleinair::app {

/// Work and memory use of a live session in one interval, for judging long runs.
struct LiveInterval {
  double from_s = 0.0, to_s = 0.0;  ///< Since the start of the session.
  std::int64_t captured = 0, tracked = 0, drawn = 0, late_for_tracking = 0, late_for_drawing = 0;
  std::int64_t lost = 0;          ///< Before they reached the session.
  std::int64_t on_the_way = 0;    ///< At its end: captured, and neither drawn nor dropped yet.
  LatencyMeter::Summary latency;  ///< Frames of this interval.
  double memory_mb = 0.0;         ///< Resident memory at its end; 1 MB is 10^6 bytes.
};

/// Divides a session into intervals.
class LiveReport {
 public:
  /// `every_s`: length of an interval; 0 disables the reports.
  explicit LiveReport(double every_s);

  /// Returns the interval that ended since the last call, if any.
  std::optional<LiveInterval> Poll(LiveSession& session);

  /// Returns the last, shorter interval; nothing when reports are disabled.
  std::optional<LiveInterval> Finish(LiveSession& session);

 private:
  using Clock = std::chrono::steady_clock;
  LiveInterval Cut(LiveSession& session, Clock::time_point now);

  const double every_s_;
  const Clock::time_point start_;
  Clock::time_point from_;
  LiveStatistics before_;
};

}  // namespace pleinair::app
