#pragma once

#include <compare>
#include <numbers>

namespace pleinair {

/// A double with its unit in the type. Defines only operations that are valid for every unit.
template <typename Tag>
class Quantity {
 public:
  constexpr Quantity() = default;
  constexpr explicit Quantity(double value) : value_(value) {}
  constexpr double value() const { return value_; }
  constexpr auto operator<=>(const Quantity&) const = default;
  constexpr Quantity operator+(Quantity other) const { return Quantity(value_ + other.value_); }
  constexpr Quantity operator-(Quantity other) const { return Quantity(value_ - other.value_); }
  constexpr Quantity operator-() const { return Quantity(-value_); }
  constexpr Quantity operator*(double factor) const { return Quantity(value_ * factor); }
  constexpr double operator/(Quantity other) const { return value_ / other.value_; }

 private:
  double value_ = 0.0;
};

using Radians = Quantity<struct RadiansTag>;
using Metres = Quantity<struct MetresTag>;
using Lux = Quantity<struct LuxTag>;                    ///< Illuminance, lm/m².
using CandelaPerM2 = Quantity<struct CandelaPerM2Tag>;  ///< Luminance, cd/m².

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// Degrees are used only for input and output: command lines and files.
constexpr Radians FromDegrees(double degrees) { return Radians(degrees * kRadiansPerDegree); }
constexpr double ToDegrees(Radians angle) { return angle.value() / kRadiansPerDegree; }

}  // namespace pleinair
