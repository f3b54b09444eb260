#pragma once

#include <string>

#include "accuracy/statistics.h"

namespace pleinair::app {

/// Formats a ratio with its interval: "0.42 (0.38–0.47)". If the data give no upper bound: "28.57
/// (13.07 or more)"; "unbounded" if the denominator is zero; "–" without data.
std::string RatioText(double ratio, const accuracy::Interval& interval);

}  // namespace pleinair::app
