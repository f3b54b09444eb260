#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sky/clouds/slab_doubling.h"

namespace pleinair::clouds {

inline constexpr double kWaterAsymmetry = 0.85;  ///< Henyey–Greenstein's g of cloud droplets.
inline constexpr double kIceAsymmetry = 0.77;    ///< The same of ice crystals.

/// What a homogeneous, plane-parallel cloud without absorption does to flux. R, S and the rest are
/// shares of the illuminance that arrives; τ is the vertical optical depth, μ₀ the cosine of the
/// sun's zenith angle.
///
/// The values are those of DoubleSlab(), tabulated over 33 depths and 17 cosines and interpolated:
/// within 2e-4 for τ up to 200 and μ₀ from 0.1 (tests/sky/clouds/cloud_slab_test.cc). Smaller
/// cosines are treated as kMinCosine. A table takes about 10 ms; those of water and ice are shared.
class SlabTable {
 public:
  explicit SlabTable(const SlabMedium& medium);

  /// The tables of kWaterAsymmetry and kIceAsymmetry without absorption. Thread-safe.
  static const SlabTable& Water();
  static const SlabTable& Ice();

  /// R, the plane albedo.
  double Reflected(double depth, double sun_cosine) const;
  /// S, the spherical albedo: R for isotropic light.
  double DiffuseReflected(double depth) const;

  static constexpr double kMinCosine = 0.02;

 private:
  double Interpolated(double depth, double cosine_place) const;

  /// (1 − 1/(1 + x)) / τ of each node, by depth, then cosine; the last column is S.
  std::vector<double> nodes_;
};

/// e^(−τ/μ₀): the share of direct light that is not scattered. 0 for a sun at the horizon.
double Unscattered(double depth, double sun_cosine);

/// Light above a layer.
struct LightAbove {
  double sun_horizontal = 0.0;  ///< E_sun μ₀, the sun's illuminance on level ground.
  double sun_cosine = 1.0;      ///< μ₀.
  double sky_horizontal = 0.0;  ///< E_sky.
};

/// Illuminance of level ground of an albedo A under a layer that covers everything:
///
///   E = (E_sun μ₀ (1 − R) + E_sky (1 − S)) / (1 − A S)
///
/// The last factor is the light between ground and cloud.
double IlluminanceBelow(const SlabTable& table, double depth, const LightAbove& light,
                        double ground_albedo);

/// The delta-Eddington approximation of R in closed form (Joseph, Wiscombe & Weinman 1976), for
/// checks: 0.03 low at μ₀ = 0.5, τ = 4 and g = 0.85.
double DeltaEddingtonReflected(double asymmetry, double depth, double sun_cosine);

}  // namespace pleinair::clouds
