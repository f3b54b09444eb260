#include "app/accuracy/ratio_text.h"

#include <fmt/format.h>

#include <cmath>

namespace pleinair::app {

std::string RatioText(double ratio, const accuracy::Interval& interval) {
  if (std::isnan(ratio)) return "–";
  const std::string value = std::isinf(ratio) ? "unbounded" : fmt::format("{:.2f}", ratio);
  if (std::isnan(interval.low)) return value + " (no interval)";
  if (std::isfinite(interval.high)) {
    return fmt::format("{} ({:.2f}–{:.2f})", value, interval.low, interval.high);
  }
  return std::isinf(interval.low) ? value : fmt::format("{} ({:.2f} or more)", value, interval.low);
}

}  // namespace pleinair::app
