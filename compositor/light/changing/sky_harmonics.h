#pragma once

#include <array>

#include "base/vector.h"
#include "compositor/light/sky_table.h"

namespace pleinair::compositor {

/// The sky's light through a cone, by nine spherical harmonics.
///
/// Radiance L is projected onto the real harmonics Y_lm up to l = 2, with the sky mirrored at the
/// horizon, so that no edge there rings. A surface that sees the share A of its cosine-weighted
/// surroundings is taken to see a cone about the mean direction b of what it sees, of the half
/// angle α with sin² α = A. By the Funk–Hecke theorem, with c = cos α:
///
///     E(b, A) = Σ_l λ_l(A) Σ_m L_lm Y_lm(b)
///     λ_0 = π (1 − c²),  λ_1 = 2π (1 − c³) / 3,  λ_2 = π (1 − c²)(1 + 3 c²) / 4
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
