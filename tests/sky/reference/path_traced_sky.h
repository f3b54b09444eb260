#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "sky/atmosphere/aerosol.h"
#include "sky/color.h"

namespace pleinair::sky::reference {

/// Air, ground and sun of a path-traced sky.
struct Scene {
  Aerosol aerosol;
  double ground_albedo = 0.15;
  double sun_elevation_deg = 30.0;
};

/// A sky by Monte Carlo: backward paths from an eye 2 m above a spherical ground through concentric
/// shells. Any number of scatterings, ground reflections included. Shares only the optical
/// constants of sky/atmosphere/air_medium.h with the product. Wavelength by wavelength, without
/// tables; the only approximation is the 400 homogeneous shells.
class PathTracedSky {
 public:
  explicit PathTracedSky(const Scene& scene);

  /// Luminance and chromaticity at an elevation and an azimuth relative to the sun's, degrees.
  /// `paths` per wavelength. Deterministic in `seed`. With a black wall, visible only to the eye:
  /// the airlight in front of it.
  XyY At(double elevation_deg, double azimuth_from_sun_deg, int paths, std::uint64_t seed,
         double wall_m = 1e300) const;

  /// The sun's illuminance on a surface facing it, lux, with the sun as a point.
  double SunNormalLux() const;

  /// 400…700 nm in steps of 20 nm.
  static constexpr int kWavelengths = 16;
  static double Wavelength(int i) { return 400.0 + 20.0 * i; }

 private:
  struct Shell {
    double outer_radius;
    double molecules, aerosol, ozone;  ///< Mean densities.
  };
  struct Coefficients {
    double molecules, aerosol, aerosol_scattering, ozone;
  };
  struct Walk;

  /// Radiance relative to the sun's irradiance, by one path.
  double Trace(Vec3 direction, const Coefficients& c, double wall_m, Walk* walk) const;
  double OpticalDepthToSun(Vec3 position, const Coefficients& c) const;
  int ShellAt(double radius) const;

  Scene scene_;
  Vec3 to_sun_;
  std::vector<Shell> shells_;
  std::array<Coefficients, kWavelengths> coefficients_;
};

}  // namespace pleinair::sky::reference
