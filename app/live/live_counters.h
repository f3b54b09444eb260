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

/// Counts what happens to a live session's frames. Any thread.
class LiveCounters {
 public:
  /// `period_ms`: since the frame before; nothing for the first.
  void Captured(const devices::Frame& frame, std::optional<double> period_ms);
  void Tracked(bool has_pose, double milliseconds);
  void Drawn(const session::RenderTimes& times, double milliseconds);
  /// On the screen, while so many were replaced before they got there so far.
  void Shown(std::int64_t late_for_screen);
  /// Not drawn since the session ended.
  void GivenUp();
  /// A frame has reached its viewer now.
  void AddLatency(const devices::Frame& frame);

  /// All that is counted here. `late`: reads how many frames were replaced before tracking and
  /// before drawing; it is called while no count changes, so that the numbers fit together.
  LiveStatistics Snapshot(const std::function<LateFrames()>& late) const;
  /// Between frames, a running mean.
  double period_ms() const;
  /// The latencies of all frames since the last call.
  LatencyHistogram TakeLatencies();

 private:
  mutable std::mutex mutex_;
  LiveStatistics counted_;
  LatencyMeter latency_;
  LatencyHistogram latencies_;  // Since they were taken.
};

}  // namespace pleinair::app
