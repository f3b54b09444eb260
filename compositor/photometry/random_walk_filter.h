#pragma once

#include "base/utc_time.h"

namespace pleinair::compositor {

/// Scalar Kalman filter of a slowly changing number (random-walk model). Measurements are weighted
/// by their inverse variances, and the weight of the state falls with its age. A measurement
/// replaces the state if it contradicts it far beyond both uncertainties: the number itself has
/// changed.
class RandomWalkFilter {
 public:
  /// `drift_per_minute` is the standard deviation of the number's own change within a minute. The
  /// variances of independent changes add.
  explicit RandomWalkFilter(double drift_per_minute) : drift_per_minute_(drift_per_minute) {}

  /// Adds a measurement; `error` is one standard deviation. Returns the measurement's weight in the
  /// new value. The weight is 1 for the first measurement, and where it replaces the state.
  double Add(double value, double error, UtcTime time);

  bool known() const { return known_; }
  /// 0 before the first measurement.
  double value() const { return value_; }
  /// Standard deviation of the value at a moment.
  double ErrorAt(UtcTime time) const;

 private:
  double drift_per_minute_;
  bool known_ = false;
  double value_ = 0.0;
  double variance_ = 0.0;
  UtcTime time_;  // Of the variance.
};

}  // namespace pleinair::compositor
