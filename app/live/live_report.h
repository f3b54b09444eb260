#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "app/live/live_session.h"

namespace pleinair::app {

/// What a live session did in a while, and how much memory it holds: what a long run is judged by.
struct LiveInterval {
  double from_s = 0.0, to_s = 0.0;  ///< Since the session's start.
  std::int64_t captured = 0, tracked = 0, drawn = 0, late_for_tracking = 0, late_for_drawing = 0;
  std::int64_t lost = 0;          ///< Before we got them.
  std::int64_t on_the_way = 0;    ///< At its end: captured since the start and nothing told yet.
  LatencyMeter::Summary latency;  ///< Of its own frames.
  double memory_mb = 0.0;         ///< Resident, at its end; 1 MB is 10^6 bytes.
};

/// Cuts a session into intervals.
class LiveReport {
 public:
  /// `every_s` 0: never.
  explicit LiveReport(double every_s);

  /// The interval that ended since, if one did.
  std::optional<LiveInterval> Poll(LiveSession& session);

  /// The interval that the end of the session cuts short; nothing where none are told.
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
