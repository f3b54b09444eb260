#pragma once

#include "base/frames.h"
#include "base/units.h"
#include "base/vector.h"

namespace pleinair::sky {

/// The five parameters of a standard general sky.
struct CieParameters {
  double a = 0.0, b = 0.0;           ///< Gradation from zenith to horizon.
  double c = 0.0, d = 0.0, e = 0.0;  ///< Indicatrix about the sun.
};

/// ISO 15469:2004 (CIE S 011/E:2003), Table 1; `type` is 1 (overcast, steep gradation) to 15
/// (white-blue turbid sky, wide solar corona).
CieParameters CieParametersOfType(int type);

/// Luminance distribution of a CIE standard general sky:
///
///   L / L_zenith = f(χ) g(Z) / (f(Z_sun) g(0)),
///   g(Z) = 1 + a e^(b / cos Z),   f(χ) = 1 + c (e^(d χ) − e^(d π/2)) + e cos² χ,
///
/// Z is the angle from the zenith, χ that from the sun. A sun below the horizon is moved to the
/// horizon.
class CieSky {
 public:
  static constexpr int kTypes = 15;

  /// `type` 1…15; `to_sun` unit vector east, north, up.
  CieSky(int type, Direction<World> to_sun);

  /// Luminance relative to the zenith's; 0 below the horizon. Never negative: the lowest f of the
  /// fifteen types is 0.81.
  double RelativeLuminance(Direction<World> from) const;

  /// Horizontal illuminance, lux, of a sky whose zenith has 1 cd/m²; relative error 6e-5.
  double IlluminanceOverZenith() const { return illuminance_over_zenith_; }

 private:
  CieParameters p_;
  Vec3 to_sun_;
  double horizon_term_ = 0.0;  ///< 1 − c e^(d π/2).
  double scale_ = 1.0;         ///< 1 / (f(Z_sun) g(0)).
  double illuminance_over_zenith_ = 0.0;

  double Gradation(double up) const;
  double Indicatrix(double chi, double cos_chi) const;
  double IntegrateIlluminance(double sun_zenith_distance) const;
};

}  // namespace pleinair::sky
