#pragma once

#include <fmt/format.h>

#include <string>

namespace pleinair::app {

/// A length with four digits in its nearest unit: "1.2 km", "0.45 m", "12 mm".
inline std::string LengthText(double length_m) {
  if (length_m >= 1000.0) return fmt::format("{:.4g} km", length_m * 1e-3);
  if (length_m < 0.1) return fmt::format("{:.4g} mm", length_m * 1e3);
  return fmt::format("{:.4g} m", length_m);
}

}  // namespace pleinair::app
