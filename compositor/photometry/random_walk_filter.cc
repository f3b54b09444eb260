#include "compositor/photometry/random_walk_filter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pleinair::compositor {
namespace {

// A measurement that deviates by more standard deviations contradicts the state.
constexpr double kContradiction = 3.0;

}  // namespace

double RandomWalkFilter::ErrorAt(UtcTime time) const {
  // A recording that starts again goes back in time.
  const auto since_ns =
      std::max<std::int64_t>(0, time.nanoseconds_since_1970() - time_.nanoseconds_since_1970());
  const double minutes = static_cast<double>(since_ns) / 60e9;
  return std::sqrt(variance_ + drift_per_minute_ * drift_per_minute_ * minutes);
}

double RandomWalkFilter::Add(double value, double error, UtcTime time) {
  const double kept = ErrorAt(time) * ErrorAt(time), seen = error * error;
  const double off = value - value_;
  const bool replaces = !known_ || off * off >= kContradiction * kContradiction * (kept + seen);
  const double weight = replaces ? 1.0 : kept / (kept + seen);
  known_ = true;
  value_ = replaces ? value : value_ + weight * off;
  // Variance of the mean weighted by inverse variances.
  variance_ = replaces ? seen : weight * seen;
  time_ = time;
  return weight;
}

}  // namespace pleinair::compositor
