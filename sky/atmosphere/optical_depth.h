#pragma once

#include <vector>

#include "sky/atmosphere/air_medium.h"

namespace pleinair::sky {

/// Table of the optical depth from a point in the air to space, over height and distance to space
/// (mapping of Bruneton 2017, §4.1). It holds upward directions only: a downward ray is two upward
/// rays that meet at its lowest point.
class OpticalDepthTable {
 public:
  explicit OpticalDepthTable(const AirMedium& medium);

  /// Optical depth per wavelength from the height `height_m` in a direction of zenith cosine `mu`.
  /// A direction that hits the ground is replaced by the grazing one.
  Spectrum ToSpace(double height_m, double mu) const;

  /// Transmittance of sunlight to a height, for the disc's centre at the zenith cosine `mu`. The
  /// disc sets gradually behind the horizon, over its angular width.
  Spectrum SunTransmittance(double height_m, double mu) const;

 private:
  static constexpr int kHeights = 64, kDirections = 192;

  Spectrum Upward(double radius, double mu) const;

  /// Column densities, in metres of air at the density maximum.
  struct Columns {
    float molecules = 0.0F, aerosol = 0.0F, ozone = 0.0F;
  };
  AirMedium medium_;
  std::vector<Columns> table_;
};

}  // namespace pleinair::sky
