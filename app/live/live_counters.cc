#include "app/live/live_counters.h"

#include <chrono>
#include <utility>

namespace pleinair::app {
namespace {

// Weight of the newest period in the running mean.
constexpr double kPeriodWeight = 0.1;

}  // namespace

void LiveCounters::Captured(const devices::Frame& frame, std::optional<double> period_ms) {
  const std::lock_guard lock(mutex_);
  if (period_ms) {
    double& mean_ms = counted_.timing.period_ms;
    mean_ms = mean_ms == 0.0 ? *period_ms : mean_ms + kPeriodWeight * (*period_ms - mean_ms);
  }
  ++counted_.frames.captured;
  counted_.loss += frame.loss;
}

void LiveCounters::Tracked(bool has_pose, double milliseconds) {
  const std::lock_guard lock(mutex_);
  ++counted_.frames.tracked;
  if (has_pose) ++counted_.frames.with_pose;
  counted_.timing.track_ms = milliseconds;
}

void LiveCounters::Drawn(const session::RenderTimes& times, double milliseconds) {
  const std::lock_guard lock(mutex_);
  ++counted_.frames.drawn;
  counted_.timing.draw_ms = milliseconds;
  counted_.timing.render = times;
}

void LiveCounters::Composed(double since_start_s) {
  const std::lock_guard lock(mutex_);
  if (counted_.first_image_s == 0.0) counted_.first_image_s = since_start_s;
}

void LiveCounters::Shown(std::int64_t late_for_screen) {
  const std::lock_guard lock(mutex_);
  ++counted_.frames.shown;
  counted_.late.for_screen = late_for_screen;
}

void LiveCounters::GivenUp() {
  const std::lock_guard lock(mutex_);
  ++counted_.on_the_way_at_end;
}

void LiveCounters::AddLatency(const devices::Frame& frame) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  const std::int64_t now_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  const double latency_ms = static_cast<double>(now_ns - frame.timestamp_ns) * 1e-6;
  const std::lock_guard lock(mutex_);
  latency_.Add(latency_ms);
  latencies_.Add(latency_ms);
}

LiveStatistics LiveCounters::Snapshot(const std::function<LateFrames()>& late) const {
  const std::lock_guard lock(mutex_);
  LiveStatistics statistics = counted_;
  const LateFrames before_screen = late();
  statistics.late.for_tracking = before_screen.for_tracking;
  statistics.late.for_drawing = before_screen.for_drawing;
  statistics.latency = latency_.Summarize();
  return statistics;
}

double LiveCounters::period_ms() const {
  const std::lock_guard lock(mutex_);
  return counted_.timing.period_ms;
}

LatencyHistogram LiveCounters::TakeLatencies() {
  const std::lock_guard lock(mutex_);
  return std::exchange(latencies_, {});
}

}  // namespace pleinair::app
