#pragma once

namespace pleinair::accuracy {

/// Inverse of the standard normal distribution function; 0 < p < 1, right to about 1e-16. Wichura
/// 1988, "Algorithm AS 241: the percentage points of the normal distribution", PPND16. Our own,
/// because the random scenes are drawn with it: the same bits from every version of a library.
double NormalQuantile(double p);

}  // namespace pleinair::accuracy
