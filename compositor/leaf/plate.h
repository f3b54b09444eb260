#pragma once

#include "base/units.h"
#include "compositor/leaf/leaf_optics.h"
#include "scene/leaf_contents.h"

namespace pleinair::compositor {

/// Mean transmittance t(a, n) of a smooth dielectric surface for unpolarized light. The light is
/// isotropic within a cone around the normal, of half-angle a = `cone` (0…90°). Source: Stern 1964,
/// "Transmission of isotropic radiation across an interface between two dielectrics", Applied
/// Optics 3. Form: Allen 1973, "Transmission of isotropic light across a dielectric surface in two
/// and three dimensions", JOSA 63. At the normal, t(0, n) = 4n / (n + 1)². `refractive_index` > 1.
double ConeTransmittance(Radians cone, double refractive_index);

/// Transmittance of an absorbing layer for light from all sides of a hemisphere:
/// θ(k) = (1 − k) e^−k + k² E₁(k), θ(0) = 1 (Allen et al. 1969, "Interaction of isotropic light
/// with a compact plant leaf", JOSA 59). E₁ by its series for k ≤ 1, else by Abramowitz & Stegun
/// 5.1.56; θ is exact to 1e-8. `k` ≥ 0: optical depth along the normal.
double LayerTransmittance(double k);

/// The surfaces of a plate for light from within a cone.
struct PlateSurface {
  double entering = 1.0;  ///< t(a, n).
  double diffuse = 1.0;   ///< t(90°, n).
  double n2 = 1.0;        ///< n².
};
PlateSurface PlateSurfaceOf(Radians cone, double refractive_index);

/// Reflectance and transmittance of an absorbing plate (Miao et al. 2016, "A real-time 3D
/// visualization approach for the appearance of crop leaves", equations 3 and 4, after Allen et al.
/// 1969):
///     ρ = 1 − t(a) + t(90) t(a) θ² (n² − t(90)) / D
///     τ = t(90) t(a) θ n² / D,      D = n⁴ − θ² (n² − t(90))²
inline LeafOptics PlateOptics(const PlateSurface& surface, double theta) {
  const double inside = surface.n2 - surface.diffuse;
  const double through = surface.diffuse * surface.entering * theta /
                         (surface.n2 * surface.n2 - theta * theta * inside * inside);
  return {1.0 - surface.entering + through * theta * inside, through * surface.n2};
}

/// The paper's model: one plate, a = 0, at 675, 546 and 435 nm. Water and anthocyanins take no
/// part. The optical depth is that of the contents times `thickness`, divided by N.
LeafColors PlateColors(const scene::Leaf& leaf, double thickness = 1.0);

}  // namespace pleinair::compositor
