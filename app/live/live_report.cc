#include "app/live/live_report.h"

#include <unistd.h>

#include <fstream>

namespace pleinair::app {
namespace {

double Seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Resident pages: the second number of /proc/self/statm (proc(5)). 0 if it cannot be read.
double ResidentMemory_mb() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  statm >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

}  // namespace

LiveReport::LiveReport(double every_s) : every_s_(every_s), start_(Clock::now()), from_(start_) {}

std::optional<LiveInterval> LiveReport::Poll(LiveSession& session) {
  const auto now = Clock::now();
  if (every_s_ <= 0.0 || Seconds(now - from_) < every_s_) return std::nullopt;
  return Cut(session, now);
}

std::optional<LiveInterval> LiveReport::Finish(LiveSession& session) {
  if (every_s_ <= 0.0) return std::nullopt;
  return Cut(session, Clock::now());
}

LiveInterval LiveReport::Cut(LiveSession& session, Clock::time_point now) {
  const LiveStatistics s = session.statistics();
  LiveInterval interval;
  interval.from_s = Seconds(from_ - start_);
  interval.to_s = Seconds(now - start_);
  interval.captured = s.frames.captured - before_.frames.captured;
  interval.tracked = s.frames.tracked - before_.frames.tracked;
  interval.drawn = s.frames.drawn - before_.frames.drawn;
  interval.late_for_tracking = s.late.for_tracking - before_.late.for_tracking;
  interval.late_for_drawing = s.late.for_drawing - before_.late.for_drawing;
  interval.lost = s.loss.Total() - before_.loss.Total();
  interval.on_the_way = s.Unaccounted();
  interval.latency = session.TakeLatencies().Summarize();
  interval.memory_mb = ResidentMemory_mb();
  before_ = s;
  from_ = now;
  return interval;
}

}  // namespace pleinair::app
