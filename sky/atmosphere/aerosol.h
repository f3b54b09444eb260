#pragma once

namespace pleinair::sky {

/// Optical properties of the aerosol in the lowest kilometres. Vertical optical depth at the
/// wavelength λ (Ångström 1929): τ(λ) = β (λ / 1 µm)^−α.
struct Aerosol {
  double beta = 0.04;              ///< Ångström's turbidity coefficient, 0…2.
  double alpha = 1.3;              ///< Ångström's exponent, 0…4.
  double scale_height_m = 1200.0;  ///< Density falls as e^(−h / scale height); 300…5000 m.
  double single_scattering_albedo = 0.93;  ///< Scattered share of the extinction, 0…1.
  double asymmetry = 0.76;                 ///< g of Henyey & Greenstein 1941, 0…0.95.

  bool operator==(const Aerosol&) const = default;
};

/// Aerosol of a turbidity T: β = 0.04608 T − 0.04586, not below 0 (Preetham et al. 1999, A.1, a fit
/// to their Fig. 3). T = 1 is air without aerosol.
Aerosol AerosolOfTurbidity(double turbidity);

}  // namespace pleinair::sky
