#pragma once

#include "base/frames.h"
#include "base/units.h"
#include "base/vector.h"
#include "sky/cie_sky.h"

namespace pleinair::sky {

/// Attenuation of a clear sky's light by clouds, as a function of cloud cover: 0 clear … 1
/// overcast. Everything is continuous in cover and in the sun's elevation. With growing cover,
/// direct sunlight, global illuminance and the cloudless share of the sky decrease, and the diffuse
/// share increases.
///
/// - Global horizontal illuminance (sun and sky): 1 − 0.75 cover^3.4 of the clear sky's (Kasten &
///   Czeplak 1980, "Solar and terrestrial radiation dependent on the amount and type of cloud",
///   Solar Energy 24, Eq. (2)).
/// - Direct sunlight: e^(−τ m) of the clear sky's, with the air mass m and the clouds' mean optical
///   depth τ = −ln(1 − cover^2.5). At a sun elevation of 30° this gives the diffuse share of Kasten
///   & Czeplak's Eq. (4), 0.3 + 0.7 cover², within 0.08 from cover 0.25 on.
/// - The rest of the global illuminance comes from the sky: (1 − cover) of the clear sky, and white
///   (D65) clouds. The cloud pattern is a blend of CIE standard general skies: type 11 (white-blue,
///   distinct corona) at cover 0, 8 (partly cloudy, distinct corona) at 1/3, 4 (overcast, brighter
///   towards the sun) at 2/3, 1 (overcast) at 1.
struct CloudTransmission {
  double global = 1.0;     ///< Factor on the clear sky's global horizontal illuminance.
  double sun = 1.0;        ///< Factor on the clear sky's direct sunlight.
  double clear_sky = 1.0;  ///< Factor on the clear sky's radiance.
};

CloudTransmission TransmissionOfClouds(double cover, Radians apparent_sun_elevation);

/// The CIE types between which a cover lies, and the weight of the upper one.
struct CloudPatterns {
  int lower = 0, upper = 0;
  double upper_share = 0.0;
};
CloudPatterns PatternsOfClouds(double cover);

/// Clouds in front of a clear sky, for one sun position: the blend described above.
class Clouds {
 public:
  /// `to_sun`: apparent, unit vector, east, north, up. `clear_sky`: the clear sky's horizontal
  /// illuminance; the last argument: the clear sun's illuminance on a surface facing it; both in
  /// lux.
  Clouds(double cover, Direction<World> to_sun, const LinearRgb& clear_sky,
         const LinearRgb& clear_sun);

  /// Luminance of the clouds alone in a direction, cd/m².
  double Luminance(Direction<World> from) const {
    return lower_zenith_cd_m2_ * lower_.RelativeLuminance(from) +
           upper_zenith_cd_m2_ * upper_.RelativeLuminance(from);
  }

  /// Radiance of clouds plus attenuated clear sky, whose unattenuated radiance in that direction is
  /// `clear`.
  LinearRgb Radiance(Direction<World> from, const LinearRgb& clear) const {
    const double cloud = Luminance(from);
    return clear * clear_share_ + LinearRgb{cloud, cloud, cloud};
  }

  /// Horizontal illuminance of clouds plus attenuated clear sky, lux.
  LinearRgb SkyHorizontalIrradiance() const { return sky_horizontal_; }

 private:
  CieSky lower_, upper_;
  double clear_share_ = 1.0;
  double lower_zenith_cd_m2_ = 0.0, upper_zenith_cd_m2_ = 0.0;
  LinearRgb sky_horizontal_;
};

}  // namespace pleinair::sky
