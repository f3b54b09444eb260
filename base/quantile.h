#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pleinair {

/// Quantile without interpolation: element floor(q (n − 1)) of the n sorted values, 0 ≤ q ≤ 1. For
/// q = 0.5 and an even n this is the lower median. Needs n ≥ 1 and no NaN.
inline double Quantile(std::vector<double> values, double q) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Median; for an even number of values the upper of the two in the middle. Needs n ≥ 1 and no NaN.
inline double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace pleinair
