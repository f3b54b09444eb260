#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "app/live/latency_meter.h"

namespace pleinair::app {

/// Latency histogram of an interval of any length, in constant memory. Bins grow by 2 %, from 0.1
/// ms to more than a minute.
class LatencyHistogram {
 public:
  void Add(double milliseconds) {
    const double step = std::log(std::max(milliseconds, kMin_ms) / kMin_ms) / std::log(kRatio);
    ++counts_[std::min(static_cast<std::size_t>(step), counts_.size() - 1)];
    ++count_;
    worst_ms_ = std::max(worst_ms_, milliseconds);
  }

  /// The maximum is exact. The quantiles are at most 2 % too high.
  LatencyMeter::Summary Summarize() const { return {Quantile(0.5), Quantile(0.95), worst_ms_}; }

 private:
  double Quantile(double share) const {
    const double rank = share * static_cast<double>(count_);
    std::int64_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      below += counts_[i];
      if (count_ > 0 && static_cast<double>(below) >= rank) {
        return std::min(kMin_ms * std::pow(kRatio, static_cast<double>(i + 1)), worst_ms_);
      }
    }
    return 0.0;
  }

  static constexpr double kMin_ms = 0.1, kRatio = 1.02;
  std::array<std::int64_t, 700> counts_{};
  std::int64_t count_ = 0;
  double worst_ms_ = 0.0;
};

}  // namespace pleinair::app
