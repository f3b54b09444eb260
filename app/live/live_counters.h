#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "app/live/latency_histogram.h"
#include "app/live/latency_meter.h"
#include "app/live/live_statistics.h"
#include "devices/frame.h"
#include "session/render_times.h"

namespace pleinair::app {

/// Counts the frames of a live session by what happened to them. Thread-safe.
class LiveCounters {
 public:
  /// `period_ms`: since the previous frame; nothing for the first.
  void Captured(const devices::Frame& frame, std::optional<double> period_ms);
  void Tracked(bool has_pose, double milliseconds);
  void Drawn(const session::RenderTimes& times, double milliseconds);
  /// Notes that a frame with a pose was composed, `since_start_s` after the start.
  void Composed(double since_start_s);
  /// Counts a frame on the screen. `late_for_screen`: drawn frames replaced before display so far.
  void Shown(std::int64_t late_for_screen);
  /// Counts a frame that is not drawn because the session ended.
  void GivenUp();
  /// Adds the latency of a frame that is displayed now.
  void AddLatency(const devices::Frame& frame);

  /// Returns all counts. `late` reads the number of frames replaced before tracking and before
  /// drawing. It is called while the counts are locked, so that all numbers are consistent.
  LiveStatistics Snapshot(const std::function<LateFrames()>& late) const;
  /// Running mean of the frame period.
  double period_ms() const;
  /// Latencies of all frames since the last call.
  LatencyHistogram TakeLatencies();

 private:
  mutable std::mutex mutex_;
  LiveStatistics counted_;
  LatencyMeter latency_;
  LatencyHistogram latencies_;  // Since the last TakeLatencies().
};

}  // namespace pleinair::app
