#pragma once

#include <array>

#include "sky/clouds/cloud_layer.h"
#include "sky/clouds/cloud_slab.h"

namespace pleinair::clouds {

/// Sunlight that a cloud scatters more than once, by octaves (Wrenninge et al. 2013). Each octave
/// n = 1…12 halves the light, the sun's optical depth and the phase function's asymmetry.
///
/// In thick layers their sum decreases as 1/τ, as light does.
///
///   J = Σ_n 2^−n p(2^−n g) e^(−2^−n τ_sun) · k / 4π
///
/// The octaves do not conserve energy. The scale k(τ, s) gives a homogeneous column of the optical
/// depth τ the upward and downward flux of SlabTable, first scattering included. k is linear in s,
/// the share of the column's depth that lies towards the sun.
class HigherOrders {
 public:
  static constexpr int kOctaves = 12;

  HigherOrders(CloudKind kind, double sun_cosine);

  /// The octaves' phase functions at an angle from the sun, with their factors 2^−n.
  using Phases = std::array<double, kOctaves>;
  Phases PhasesAt(double cosine) const;

  /// J / E_sun, per steradian. `sun_depth` along the ray to the sun; `column` is the vertical
  /// depth.
  double Source(const Phases& phases, double sun_depth, double column) const;

 private:
  struct Scale {
    double lit = 0.0, shaded = 0.0;  ///< k at s = 0 and s = 1.
  };
  static constexpr int kDepths = 29;
  Scale ScaleOf(double column) const;
  Scale SolveScale(CloudKind kind, const SlabTable& table, double depth) const;

  double asymmetry_, sun_cosine_;
  std::array<Scale, kDepths> scales_;
};

}  // namespace pleinair::clouds
