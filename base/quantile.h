#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pleinair {

/// The value that a share `q`, 0 to 1, of the others lie below, without interpolation; for even
/// counts the lower of the two in the middle. At least one value, none of them NaN.
inline double Quantile(std::vector<double> values, double q) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The same for one half, of even counts the upper of the two in the middle.
inline double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace pleinair
