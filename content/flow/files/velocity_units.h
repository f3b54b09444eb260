#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pleinair::content {

/// Metres per second of a unit of velocity: "m s-1", "m/s", "knots", "km/h", "cm/s" and their other
/// spellings. Unset: not known.
std::optional<double> MetresPerSecond(std::string_view unit);

/// Metres of a unit of length: "m", "km", "metre". Unset: not known, or no length.
std::optional<double> MetresOf(std::string_view unit);

constexpr const char* kVelocityUnits = "m s-1, m/s, knots, km/h and cm/s";

}  // namespace pleinair::content
