#pragma once

#include <vector>

namespace pleinair::shadows {

/// Practical split scheme: depths that divide a view between `near_m` and `far_m` into `partitions`
/// slices; partitions + 1 values from near to far.
///
///     C_i = λ n (f/n)^(i/m) + (1 − λ) (n + (f − n) i/m),  i = 0…m
///
/// Kolivand & Sunar 2014, Eqs. 11–13, after Zhang et al. 2006. `weight` is λ: 0 uniform, 1
/// logarithmic, ½ is their Eq. 10. Deviation: Eq. 12 has the exponent i, which leaves the range [n,
/// f]; i/m is meant. Needs 0 < near_m < far_m, partitions ≥ 1.
std::vector<double> PracticalSplits(double near_m, double far_m, int partitions, double weight);

}  // namespace pleinair::shadows
