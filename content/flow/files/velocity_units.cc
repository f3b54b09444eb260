#include "content/flow/files/velocity_units.h"

#include <array>
#include <cctype>
#include <utility>

namespace pleinair::content {
namespace {

constexpr double kKnot = 1852.0 / 3600.0;

/// Lower case, without spaces, brackets, full stops, stars and circumflexes.
std::string Plain(std::string_view unit) {
  std::string plain;
  for (const char c : unit) {
    if (std::string_view(" \t.*^[]()_").find(c) != std::string_view::npos) continue;
    plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

template <std::size_t kCount>
std::optional<double> Find(const std::array<std::pair<const char*, double>, kCount>& units,
                           std::string_view unit) {
  const std::string plain = Plain(unit);
  for (const auto& [name, value] : units) {
    if (plain == name) return value;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> MetresPerSecond(std::string_view unit) {
  static constexpr std::array<std::pair<const char*, double>, 33> kUnits = {{
      {"ms-1", 1.0},
      {"m/s", 1.0},
      {"m/sec", 1.0},
      {"msec-1", 1.0},
      {"ms^-1", 1.0},
      {"meter/second", 1.0},
      {"metre/second", 1.0},
      {"meters/second", 1.0},
      {"metres/second", 1.0},
      {"meter/sec", 1.0},
      {"metersecond-1", 1.0},
      {"metresecond-1", 1.0},
      {"meterssecond-1", 1.0},
      {"metressecond-1", 1.0},
      {"meterspersecond", 1.0},
      {"metrespersecond", 1.0},
      {"mps", 1.0},
      {"knots", kKnot},
      {"knot", kKnot},
      {"kt", kKnot},
      {"kts", kKnot},
      {"kn", kKnot},
      {"km/h", 1.0 / 3.6},
      {"kmh-1", 1.0 / 3.6},
      {"kmh", 1.0 / 3.6},
      {"kph", 1.0 / 3.6},
      {"km/hr", 1.0 / 3.6},
      {"kmhr-1", 1.0 / 3.6},
      {"km/hour", 1.0 / 3.6},
      {"cm/s", 0.01},
      {"cms-1", 0.01},
      {"mm/s", 0.001},
      {"mms-1", 0.001},
  }};
  return Find(kUnits, unit);
}

std::optional<double> MetresOf(std::string_view unit) {
  static constexpr std::array<std::pair<const char*, double>, 9> kUnits = {{
      {"m", 1.0},
      {"meter", 1.0},
      {"meters", 1.0},
      {"metre", 1.0},
      {"metres", 1.0},
      {"km", 1000.0},
      {"kilometer", 1000.0},
      {"kilometre", 1000.0},
      {"cm", 0.01},
  }};
  return Find(kUnits, unit);
}

}  // namespace pleinair::content
