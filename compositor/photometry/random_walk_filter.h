#pragma once

#include "base/utc_time.h"

namespace pleinair::compositor {

/// A number that is measured again and again while it changes slowly. Measurements are combined by
/// their uncertainties; what was known counts the less the older it is. A measurement that
/// contradicts it far beyond both uncertainties replaces it: then the thing itself has changed.
class RandomWalkFilter {
 public:
  /// `drift_per_minute`: standard deviation of what the number itself changes by within a minute.
  /// Of changes that do not depend on each other, the variances add.
  explicit RandomWalkFilter(double drift_per_minute) : drift_per_minute_(drift_per_minute) {}

  /// Counts a measurement in. Gives its weight in the new value, beside what was known until now:
  /// 1 where nothing was, or where it replaces that. `error`: one standard deviation.
  double Add(double value, double error, UtcTime time);

  bool known() const { return known_; }
  /// 0 before the first measurement.
  double value() const { return value_; }
  /// Of the value at a moment, one standard deviation.
  double ErrorAt(UtcTime time) const;

 private:
  double drift_per_minute_;
  bool known_ = false;
  double value_ = 0.0;
  double variance_ = 0.0;
  UtcTime time_;  // Of the variance.
};

}  // namespace pleinair::compositor
