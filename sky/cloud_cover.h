#pragma once

#include "base/units.h"

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

}  // namespace pleinair::sky
