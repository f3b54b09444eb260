#pragma once

#include <vector>

namespace pleinair::clouds {

/// A homogeneous, plane-parallel layer of scattering particles.
struct SlabMedium {
  double asymmetry = 0.85;                ///< Henyey–Greenstein's g, −1…1.
  double single_scattering_albedo = 1.0;  ///< Share of extinction that is scattering, 0…1.
};

/// Fluxes of a slab above black ground, as shares of what arrives at its top.
struct SlabFluxes {
  /// For direct light from each of the directions asked for.
  struct Direct {
    double reflected = 0.0;    ///< R, plane albedo.
    double transmitted = 0.0;  ///< Diffuse and unscattered together.
  };
  std::vector<Direct> direct;
  double diffuse_reflected = 0.0;    ///< S, spherical albedo.
  double diffuse_transmitted = 0.0;  ///< The same for isotropic light from above.
};

/// Fluxes of slabs with the optical depths `first_depth` · 2^k, k = 0…count−1. `sun_cosines`:
/// cosines from the vertical of the direct light, 0 < μ₀ ≤ 1.
///
/// Adding–doubling (van de Hulst 1963; Hansen & Travis 1974, §4) of the azimuthal mean, with 24
/// Gaussian directions a hemisphere. The phase function is delta-M scaled (Wiscombe 1977). The
/// first thin layer is a diamond difference (Wiscombe 1976), which conserves energy. With
/// conservative scattering, R + T = 1 to 1e-9.
std::vector<SlabFluxes> DoubleSlab(const SlabMedium& medium, double first_depth, int count,
                                   const std::vector<double>& sun_cosines);

}  // namespace pleinair::clouds
