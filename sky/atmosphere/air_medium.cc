#include "sky/atmosphere/air_medium.h"
#include "sky/henyey_greenstein.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::sky {

using std::numbers::pi;

double MoleculeScattering(double wavelength_nm) {
  const double micrometres = wavelength_nm * 1e-3;
  return 1.24062e-6 / (micrometres * micrometres * micrometres * micrometres);
}

double AerosolExtinction(const Aerosol& aerosol, double wavelength_nm) {
  return aerosol.beta * std::pow(wavelength_nm * 1e-3, -aerosol.alpha) / aerosol.scale_height_m;
}

double OzoneAbsorption(double wavelength_nm) {
  // 300 Dobson units of 2.687e20 molecules/m², as a triangle over height: 10, 25, 40 km.
  constexpr double kMaxDensity = 300.0 * 2.687e20 / 15'000.0;
  return kMaxDensity * OzoneCrossSection(wavelength_nm);
}

double OzoneDensity(double height_m) {
  return std::max(0.0, 1.0 - std::fabs(height_m - 25'000.0) / 15'000.0);
}

double MoleculePhase(double cosine) { return 3.0 / (16.0 * pi) * (1.0 + cosine * cosine); }

double AerosolPhase(double asymmetry, double cosine) {
  return HenyeyGreenstein(asymmetry, cosine) / (4.0 * pi);
}

AirMedium::AirMedium(const Aerosol& haze, double albedo) : aerosol(haze), ground_albedo(albedo) {
  for (int i = 0; i < Spectrum::kSize; ++i) {
    const double wavelength = WavelengthNm(i);
    const double extinction = AerosolExtinction(haze, wavelength);
    molecules.v[i] = static_cast<float>(MoleculeScattering(wavelength));
    aerosol_extinction.v[i] = static_cast<float>(extinction);
    aerosol_scattering.v[i] = static_cast<float>(extinction * haze.single_scattering_albedo);
    ozone.v[i] = static_cast<float>(OzoneAbsorption(wavelength));
  }
}

AirMedium::Densities AirMedium::DensitiesAt(double height_m) const {
  const auto h = static_cast<float>(height_m);
  return {ExpOfNegative(-h / static_cast<float>(kMoleculeScaleHeight)),
          ExpOfNegative(-h / static_cast<float>(aerosol.scale_height_m)),
          static_cast<float>(OzoneDensity(height_m))};
}

}  // namespace pleinair::sky
