#include "sky/sunlight_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sky/air_mass.h"
#include "sky/cie_observer.h"
#include "sky/color.h"

namespace pleinair::sky {
namespace {

/// One band of 10 nm, at the wavelengths of kCie1931.
struct Band {
  double solar;         ///< Radiance of the sun's disc, 100 W / (m² sr nm).
  double ozone_per_cm;  ///< Absorption coefficients.
  double water_per_cm;
};

// Preetham et al. 1999, Table 2 (the sun's spectral radiance; ozone and water vapour, after Iqbal
// 1983).
constexpr std::array<Band, kCie1931.size()> kBands = {{
    {165.5, 0, 0},         {162.3, 0, 0},          {211.2, 0, 0},       {258.8, 0, 0},
    {258.2, 0, 0},         {242.3, 0, 0},          {267.6, 0, 0},       {296.6, 0.003, 0},
    {305.4, 0.006, 0},     {300.6, 0.009, 0},      {306.6, 0.014, 0},   {288.3, 0.021, 0},
    {287.1, 0.030, 0},     {278.2, 0.040, 0},      {271.0, 0.048, 0},   {272.3, 0.063, 0},
    {263.6, 0.075, 0},     {255.0, 0.085, 0},      {250.6, 0.103, 0},   {253.1, 0.120, 0},
    {253.5, 0.120, 0},     {251.3, 0.115, 0},      {246.3, 0.125, 0},   {241.7, 0.120, 0},
    {236.8, 0.105, 0},     {232.1, 0.090, 0},      {228.2, 0.079, 0},   {223.4, 0.067, 0},
    {219.7, 0.057, 0},     {215.3, 0.048, 0},      {211.0, 0.036, 0},   {207.3, 0.028, 0.016},
    {202.4, 0.023, 0.024}, {198.7, 0.018, 0.0125}, {194.3, 0.014, 1.0}, {190.7, 0.011, 0.87},
    {186.3, 0.010, 0.061}, {182.6, 0.009, 0.001},
}};

// Solid angle of the disc of 959.63″ at 1 au.
constexpr double kDiscSolidAngle = 6.7998e-5;
constexpr double kOzoneCm = 0.35;
constexpr double kWaterCm = 2.0;
constexpr double kAngstromExponent = 1.3;

/// Preetham et al. 1999, A.1. Its mixed gases absorb from 760 to 770 nm only, beyond the bands.
double TransmittanceOf(std::size_t i, double turbidity, double air_mass) {
  const Band& band = kBands[i];
  const double micrometres = kCie1931[i].wavelength_nm * 1e-3;
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
  for (std::size_t i = 0; i < kBands.size(); ++i) {
    const double irradiance = 100.0 * kBands[i].solar * kDiscSolidAngle /
                              (distance_au * distance_au) * TransmittanceOf(i, turbidity, air_mass);
    x += kCie1931[i].x * irradiance;
    y += kCie1931[i].y * irradiance;
    z += kCie1931[i].z * irradiance;
  }
  return ClipToGamut(RgbFromXyz(x, y, z) * (kLumensPerWatt * kObserverStepNm));
}

}  // namespace pleinair::sky
