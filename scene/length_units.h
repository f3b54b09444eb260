#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace pleinair::scene {

/// Unit of length of a model's file.
struct LengthUnit {
  std::string_view name;
  double metres;
};

/// Units that a scene may name; inch and foot by the international yard of 1959.
inline constexpr std::array<LengthUnit, 5> kLengthUnits = {
    {{"mm", 0.001}, {"cm", 0.01}, {"m", 1.0}, {"in", 0.0254}, {"ft", 0.3048}}};

/// Metres of a unit, or nothing if the name is unknown.
constexpr std::optional<double> MetresOfUnit(std::string_view name) {
  for (const LengthUnit& unit : kLengthUnits) {
    if (unit.name == name) return unit.metres;
  }
  return std::nullopt;
}

/// Name of a unit; empty if there is none of this length.
constexpr std::string_view NameOfUnit(double metres) {
  for (const LengthUnit& unit : kLengthUnits) {
    if (unit.metres == metres) return unit.name;
  }
  return {};
}

}  // namespace pleinair::scene
