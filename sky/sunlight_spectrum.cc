#include "sky/sunlight_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sky/air_mass.h"
#include "sky/colour.h"

namespace pleinair::sky {
namespace {

/// One band of 10 nm.
struct Band {
  double wavelength_nm;
  double solar;         ///< Radiance of the sun's disc, 100 W / (m² sr nm).
  double x, y, z;       ///< CIE 1931 2° observer.
  double ozone_per_cm;  ///< Absorption coefficients.
  double water_per_cm;
};

// Preetham et al. 1999, Table 2 (the sun's spectral radiance; ozone and water vapour, after Iqbal
// 1983); CIE 15:2004, Table T.4.
constexpr std::array<Band, 38> kBands = {{
    {380, 165.5, 0.001368, 0.000039, 0.006450, 0, 0},
    {390, 162.3, 0.004243, 0.000120, 0.020050, 0, 0},
    {400, 211.2, 0.014310, 0.000396, 0.067850, 0, 0},
    {410, 258.8, 0.043510, 0.001210, 0.207400, 0, 0},
    {420, 258.2, 0.134380, 0.004000, 0.645600, 0, 0},
    {430, 242.3, 0.283900, 0.011600, 1.385600, 0, 0},
    {440, 267.6, 0.348280, 0.023000, 1.747060, 0, 0},
    {450, 296.6, 0.336200, 0.038000, 1.772110, 0.003, 0},
    {460, 305.4, 0.290800, 0.060000, 1.669200, 0.006, 0},
    {470, 300.6, 0.195360, 0.090980, 1.287640, 0.009, 0},
    {480, 306.6, 0.095640, 0.139020, 0.812950, 0.014, 0},
    {490, 288.3, 0.032010, 0.208020, 0.465180, 0.021, 0},
    {500, 287.1, 0.004900, 0.323000, 0.272000, 0.030, 0},
    {510, 278.2, 0.009300, 0.503000, 0.158200, 0.040, 0},
    {520, 271.0, 0.063270, 0.710000, 0.078250, 0.048, 0},
    {530, 272.3, 0.165500, 0.862000, 0.042160, 0.063, 0},
    {540, 263.6, 0.290400, 0.954000, 0.020300, 0.075, 0},
    {550, 255.0, 0.433450, 0.994950, 0.008750, 0.085, 0},
    {560, 250.6, 0.594500, 0.995000, 0.003900, 0.103, 0},
    {570, 253.1, 0.762100, 0.952000, 0.002100, 0.120, 0},
    {580, 253.5, 0.916300, 0.870000, 0.001650, 0.120, 0},
    {590, 251.3, 1.026300, 0.757000, 0.001100, 0.115, 0},
    {600, 246.3, 1.062200, 0.631000, 0.000800, 0.125, 0},
    {610, 241.7, 1.002600, 0.503000, 0.000340, 0.120, 0},
    {620, 236.8, 0.854450, 0.381000, 0.000190, 0.105, 0},
    {630, 232.1, 0.642400, 0.265000, 0.000050, 0.090, 0},
    {640, 228.2, 0.447900, 0.175000, 0.000020, 0.079, 0},
    {650, 223.4, 0.283500, 0.107000, 0, 0.067, 0},
    {660, 219.7, 0.164900, 0.061000, 0, 0.057, 0},
    {670, 215.3, 0.087400, 0.032000, 0, 0.048, 0},
    {680, 211.0, 0.046770, 0.017000, 0, 0.036, 0},
    {690, 207.3, 0.022700, 0.008210, 0, 0.028, 0.016},
    {700, 202.4, 0.011359, 0.004102, 0, 0.023, 0.024},
    {710, 198.7, 0.005790, 0.002091, 0, 0.018, 0.0125},
    {720, 194.3, 0.002899, 0.001047, 0, 0.014, 1.0},
    {730, 190.7, 0.001440, 0.000520, 0, 0.011, 0.87},
    {740, 186.3, 0.000690, 0.000249, 0, 0.010, 0.061},
    {750, 182.6, 0.000332, 0.000120, 0, 0.009, 0.001},
}};

constexpr double kBandWidthNm = 10.0;
constexpr double kLumensPerWatt = 683.0;  // At 555 nm, by definition of the candela.
// Solid angle of the disc of 959.63″ at 1 au.
constexpr double kDiscSolidAngle = 6.7998e-5;
constexpr double kOzoneCm = 0.35;
constexpr double kWaterCm = 2.0;
constexpr double kAngstromExponent = 1.3;

/// Preetham et al. 1999, A.1. Its mixed gases absorb from 760 to 770 nm only, beyond the bands.
double Transmittance(const Band& band, double turbidity, double air_mass) {
  const double micrometres = band.wavelength_nm * 1e-3;
  const double aerosol = std::max(0.0, 0.04608 * turbidity - 0.04586);
  const double depth = 0.008735 * std::pow(micrometres, -4.08) +
                       aerosol * std::pow(micrometres, -kAngstromExponent) +
                       band.ozone_per_cm * kOzoneCm;
  const double water = band.water_per_cm * kWaterCm * air_mass;
  return std::exp(-depth * air_mass - 0.2385 * water / std::pow(1.0 + 20.07 * water, 0.45));
}

}  // namespace

LinearRgb DirectSunIrradiance(double turbidity, Radians apparent_elevation, double distance_au) {
  const double air_mass = RelativeAirMass(apparent_elevation);
  double x = 0.0, y = 0.0, z = 0.0;
  for (const Band& band : kBands) {
    const double irradiance = 100.0 * band.solar * kDiscSolidAngle / (distance_au * distance_au) *
                              Transmittance(band, turbidity, air_mass);
    x += band.x * irradiance;
    y += band.y * irradiance;
    z += band.z * irradiance;
  }
  return ClipToGamut(RgbFromXyz(x, y, z) * (kLumensPerWatt * kBandWidthNm));
}

double LuminousTransmittance(double turbidity, Radians apparent_elevation) {
  const double air_mass = RelativeAirMass(apparent_elevation);
  double passed = 0.0, all = 0.0;
  for (const Band& band : kBands) {
    passed += band.y * band.solar * Transmittance(band, turbidity, air_mass);
    all += band.y * band.solar;
  }
  return passed / all;
}

}  // namespace pleinair::sky
