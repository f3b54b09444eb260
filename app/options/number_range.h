#pragma once

#include <cmath>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "files/csv.h"

namespace pleinair::app {

/// Validates an option as a finite number within [low, high]. CLI11's own Range accepts NaN.
inline CLI::Validator NumberRange(double low, double high) {
  const std::string range =
      "[" + CLI::detail::to_string(low) + " - " + CLI::detail::to_string(high) + "]";
  return CLI::Validator(
      [low, high, range](std::string& input) {
        const std::optional<double> value = files::ParseNumber(input);
        if (value && *value >= low && *value <= high) return std::string();
        return "\"" + input + "\" is not a number in " + range;
      },
      range);
}

}  // namespace pleinair::app
