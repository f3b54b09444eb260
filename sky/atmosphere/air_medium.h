#pragma once

#include "sky/atmosphere/aerosol.h"
#include "sky/atmosphere/spectral_bands.h"

namespace pleinair::sky {

/// The air as a participating medium: a spherical shell of molecules, aerosol and ozone. Lengths in
/// metres, coefficients in 1/m. Structure and constants: Bruneton 2017, "A Qualitative and
/// Quantitative Evaluation of 8 Clear Sky Models", §3, and his published implementation.
struct AirMedium {
  static constexpr double kGroundRadius = 6'360'000.0;
  static constexpr double kTopRadius = 6'460'000.0;
  static constexpr double kTopHeight = kTopRadius - kGroundRadius;
  static constexpr double kMoleculeScaleHeight = 8'000.0;
  /// The eye's height above the ground.
  static constexpr double kEyeHeight = 2.0;

  /// Densities at a height, relative to their maxima: molecules, aerosol, ozone.
  struct Densities {
    float molecules = 0.0F, aerosol = 0.0F, ozone = 0.0F;
  };

  Aerosol aerosol;
  double ground_albedo = 0.0;
  Spectrum molecules;           ///< Scattering at the ground; molecules do not absorb.
  Spectrum aerosol_extinction;  ///< At the ground.
  Spectrum aerosol_scattering;  ///< At the ground.
  Spectrum ozone;               ///< Absorption at 25 km.

  AirMedium(const Aerosol& haze, double albedo);

  Densities DensitiesAt(double height_m) const;

  Spectrum Extinction(const Densities& d) const {
    Spectrum s = molecules * d.molecules;
    s.AddScaled(aerosol_extinction, d.aerosol);
    s.AddScaled(ozone, d.ozone);
    return s;
  }
};

// Coefficients at any wavelength, 1/m.
double MoleculeScattering(double wavelength_nm);
double AerosolExtinction(const Aerosol& aerosol, double wavelength_nm);
double OzoneAbsorption(double wavelength_nm);
/// Density of ozone relative to its maximum at 25 km; 0 below 10 km and above 40 km.
double OzoneDensity(double height_m);

/// Phase function (1/sr) of a scattering angle, given by its cosine; integrates to 1 over the
/// sphere.
double MoleculePhase(double cosine);
/// Phase function (1/sr) of Henyey & Greenstein 1941, Eq. (2).
double AerosolPhase(double asymmetry, double cosine);

}  // namespace pleinair::sky
