#pragma once

#include <string>

#include "accuracy/statistics.h"

namespace pleinair::app {

/// A ratio with its interval, as pages show it: "0.42 (0.38–0.47)". Where the data do not bound it,
/// "28.57 (13.07 or more)"; "unbounded" where theirs is nothing; "–" without any data.
std::string RatioText(double ratio, const accuracy::Interval& interval);

}  // namespace pleinair::app
