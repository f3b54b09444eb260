#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace pleinair::app {

/// Latency from exposure to display, in milliseconds and in constant memory: quantiles of the last
/// frames, and the maximum since the start.
class LatencyMeter {
 public:
  struct Summary {
    double median_ms = 0.0, p95_ms = 0.0, worst_ms = 0.0;
  };

  void Add(double milliseconds) {
    recent_[count_++ % recent_.size()] = static_cast<float>(milliseconds);
    worst_ms_ = std::max(worst_ms_, milliseconds);
  }

  Summary Summarize() const {
    Summary summary{0.0, 0.0, worst_ms_};
    const std::size_t known = std::min(count_, recent_.size());
    if (known == 0) return summary;
    auto sorted = recent_;
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(known));
    summary.median_ms = static_cast<double>(sorted[known / 2]);
    summary.p95_ms = static_cast<double>(sorted[known * 95 / 100]);
    return summary;
  }

 private:
  std::array<float, 1024> recent_{};
  std::size_t count_ = 0;
  double worst_ms_ = 0.0;
};

}  // namespace pleinair::app
