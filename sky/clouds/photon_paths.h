#pragma once

#include <cstdint>
#include <functional>

#include "base/vector.h"

namespace pleinair::clouds {

/// A cloud in a horizontal layer, for paths of photons. East, north, up in metres.
struct CloudVolume {
  std::function<double(Vec3)> extinction;  ///< Per metre; 0 outside the cloud.
  double most_extinction = 0.0;            ///< A bound of it.
  double bottom_m = 0.0, top_m = 0.0;
  /// Photons enter evenly over a square of this side. The cloud repeats beyond, or is endless.
  double side_m = 1.0;
  double asymmetry = 0.85;                ///< Henyey–Greenstein's g.
  double single_scattering_albedo = 1.0;  ///< Share of extinction that is scattering.
};

/// Shares of the photons. Black ground, no air.
struct PhotonFluxes {
  double reflected = 0.0;
  double transmitted = 0.0;  ///< Scattered and direct together.
  double direct = 0.0;       ///< Never scattered.
  double absorbed = 0.0;
  double error = 0.0;  ///< Standard deviation of the largest share.
};

/// Follows photons from the sun through a cloud: the reference for tables, columns and octaves.
/// Free paths by delta tracking (Woodcock et al. 1965). The result depends on the seed alone, not
/// on the number of threads. `to_sun`: unit vector, z > 0.
PhotonFluxes TracePhotons(const CloudVolume& cloud, Vec3 to_sun, int photons, std::uint64_t seed);

/// The step cloud of the I3RC, case 1. Strips along y repeat every 500 m. One half of each has the
/// optical depth 2, the other 18. It is 250 m thick; g = 0.85.
struct StepCloud {
  static constexpr double kPeriod_m = 500.0, kThickness_m = 250.0, kThin = 2.0, kThick = 18.0;

  /// Vertical optical depth of the column at x.
  static double Depth(double x_m);
  /// Optical depth of a ray from (x, 0) at the bottom towards `to_sun`.
  static double DepthAlong(double x_m, Vec3 to_sun);
  static CloudVolume Volume();
};

}  // namespace pleinair::clouds
