#pragma once

#include <vector>

#include "sky/atmosphere/air_medium.h"

namespace pleinair::sky {

/// Optical depth from a point of the air to space, at any height and direction that misses the
/// ground; a table over height and distance to space (mapping of Bruneton 2017, §4.1, here for
/// upward directions only: a downward ray is two upward rays that meet where it is lowest).
class OpticalDepthTable {
 public:
  explicit OpticalDepthTable(const AirMedium& medium);

  /// Per wavelength, from the height `height_m` towards a direction whose zenith has the cosine
  /// `mu`. Directions that hit the ground are bent up to graze it.
  Spectrum ToSpace(double height_m, double mu) const;

  /// Share of the sun's light that arrives at a height, its centre at the zenith cosine `mu`: the
  /// disc sets behind the ground's edge over its width.
  Spectrum SunTransmittance(double height_m, double mu) const;

 private:
  static constexpr int kHeights = 64, kDirections = 192;

  Spectrum Upward(double radius, double mu) const;

  /// Columns, in metres of the densest air.
  struct Columns {
    float molecules = 0.0F, aerosol = 0.0F, ozone = 0.0F;
  };
  AirMedium medium_;
  std::vector<Columns> table_;
};

}  // namespace pleinair::sky
