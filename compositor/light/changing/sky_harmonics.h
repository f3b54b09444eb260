#pragma once

#include <array>

#include "base/vector.h"
#include "compositor/light/sky_table.h"

namespace pleinair::compositor {

/// The sky's irradiance through a cone, by nine spherical harmonics.
///
/// Radiance L is projected onto the real harmonics Y_lm up to l = 2. The sky is mirrored at the
/// horizon, so that no edge there causes ringing.
///
/// Let A be the share of its cosine-weighted surroundings that a surface sees, and b the mean
/// direction of that share. The surface is assumed to see a cone about b with the half angle α,
/// sin² α = A. By the Funk–Hecke theorem, its irradiance is
///
///     E(b, A) = Σ_l λ_l(A) Σ_m L_lm Y_lm(b).
///
/// With c = cos α, the factors are
///
///     λ_0 = π (1 − c²),  λ_1 = 2π (1 − c³) / 3,  λ_2 = π (1 − c²)(1 + 3 c²) / 4.
///
/// For A = 1 these are Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance
/// Environment Maps", Eq. 8.
class SkyHarmonics {
 public:
  SkyHarmonics() = default;
  explicit SkyHarmonics(const SkyTable& sky);

  /// Irradiance in the sky's unit (lux, linear Rec.709), never negative. `bent`: unit, marker
  /// coordinates; `openness`: 0…1.
  std::array<float, 3> Irradiance(Vec3 bent, double openness) const;

 private:
  std::array<std::array<double, 3>, 9> coefficients_{};
};

}  // namespace pleinair::compositor
