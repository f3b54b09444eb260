#pragma once

#include <array>

#include "base/frames.h"
#include "base/vector.h"
#include "sky/sky_model.h"

namespace pleinair::sky {

/// A sky in nine real spherical harmonics per channel (order 2): quick sky light for any normal.
/// The sun's disc is never in it.
///
/// Ramamoorthi & Hanrahan 2001, "An efficient representation for irradiance environment maps". For
/// skies the error is at most 4 % of the largest irradiance, 1.6 % rms
/// (tests/sky/spherical_harmonics_test.cc).
struct SkyHarmonics {
  /// Radiance coefficients in their order: L00, L1−1, L10, L11, L2−2, L2−1, L20, L21, L22 with
  /// x east, y north, z up.
  std::array<LinearRgb, 9> radiance;

  /// Irradiance (lux) on a surface of this unit normal, nothing in the way; their Eq. (13). Not
  /// negative.
  LinearRgb Irradiance(Direction<World> normal) const;
};

/// Projects the upper hemisphere of the sky (black below): their Eq. (10), by a midpoint rule of 64
/// rings and 128 sectors.
SkyHarmonics ProjectSky(const SkyModel& model);

}  // namespace pleinair::sky
