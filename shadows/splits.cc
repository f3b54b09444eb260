#include "shadows/splits.h"

#include <cmath>

#include "base/check.h"

namespace pleinair::shadows {

std::vector<double> PracticalSplits(double near_m, double far_m, int partitions, double weight) {
  CHECK_GT(near_m, 0.0);
  CHECK_GT(far_m, near_m);
  CHECK_GE(partitions, 1);
  std::vector<double> splits(static_cast<std::size_t>(partitions) + 1);
  for (int i = 0; i <= partitions; ++i) {
    const double share = static_cast<double>(i) / partitions;
    const double logarithmic = near_m * std::pow(far_m / near_m, share);
    const double uniform = near_m + (far_m - near_m) * share;
    splits[i] = weight * logarithmic + (1.0 - weight) * uniform;
  }
  splits.front() = near_m;  // Avoids gaps at the ends from rounding.
  splits.back() = far_m;
  return splits;
}

}  // namespace pleinair::shadows
