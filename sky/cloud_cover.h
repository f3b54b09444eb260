#pragma once

#include "base/frames.h"
#include "base/units.h"
#include "base/vector.h"
#include "sky/cie_sky.h"

namespace pleinair::sky {

/// What clouds leave of the light of a clear sky, by one parameter: cover, 0 clear … 1 overcast.
/// Everything is continuous in cover and in the sun's height; with growing cover the sun, the
/// light on level ground and the cloudless share of the sky fall, the diffuse share rises.
///
/// - Light on level ground, sun and sky together: 1 − 0.75 cover^3.4 of the clear sky's (Kasten &
///   Czeplak 1980, "Solar and terrestrial radiation dependent on the amount and type of cloud",
///   Solar Energy 24, Eq. (2)).
/// - The sun: e^(−τ m) of the clear sky's, with the air mass m and the clouds' mean optical depth
///   τ = −ln(1 − cover^2.5), which at a sun of 30° gives the diffuse share of Kasten &
///   Czeplak's Eq. (4), 0.3 + 0.7 cover², within 0.08 from cover 0.25 on.
/// - What the sun does not bring comes from the sky: (1 − cover) of the clear sky, the rest
///   from clouds, white (D65), in patterns of the CIE standard general skies that pass from one
///   into the next: type 11 (white-blue, distinct corona) at cover 0, 8 (partly cloudy, distinct
///   corona) at 1/3, 4 (overcast, brighter towards the sun) at 2/3, 1 (overcast) at 1.
struct CloudTransmission {
  double global = 1.0;     ///< Of the clear illuminance of level ground.
  double sun = 1.0;        ///< Of the clear sun.
  double clear_sky = 1.0;  ///< Of the clear sky's radiance.
};

CloudTransmission TransmissionOfClouds(double cover, Radians apparent_sun_elevation);

/// The CIE types that a cover lies between, and the share of the upper one.
struct CloudPatterns {
  int lower = 0, upper = 0;
  double upper_share = 0.0;
};
CloudPatterns PatternsOfClouds(double cover);

/// Clouds before a clear sky, for one place of the sun: the blend described above.
class Clouds {
 public:
  /// `to_sun` apparent, a unit vector east, north, up; of the clear sky: its light on level ground
  /// (`clear_sky`) and the sun's on a surface facing it, lux.
  Clouds(double cover, Direction<World> to_sun, const LinearRgb& clear_sky,
         const LinearRgb& clear_sun);

  /// The clouds' own luminance in a direction, cd/m².
  double Luminance(Direction<World> from) const {
    return lower_zenith_cd_m2_ * lower_.RelativeLuminance(from) +
           upper_zenith_cd_m2_ * upper_.RelativeLuminance(from);
  }

  /// Clouds and what is left of the clear sky, whose radiance in that direction is `clear`.
  LinearRgb Radiance(Direction<World> from, const LinearRgb& clear) const {
    const double cloud = Luminance(from);
    return clear * clear_share_ + LinearRgb{cloud, cloud, cloud};
  }

  /// Of both on level ground, lux.
  LinearRgb SkyHorizontalIrradiance() const { return sky_horizontal_; }

 private:
  CieSky lower_, upper_;
  double clear_share_ = 1.0;
  double lower_zenith_cd_m2_ = 0.0, upper_zenith_cd_m2_ = 0.0;
  LinearRgb sky_horizontal_;
};

}  // namespace pleinair::sky
