#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace pleinair::sky {

/// e^x for x ≤ 0 (larger x counts as 0), with a relative error below 2e-7 (1 + |x|). Below −87 it
/// is 1e-38, never a denormal. Unlike std::exp it vectorises and gives the same bits on every
/// machine.
inline float ExpOfNegative(float x) {
  constexpr float kLog2E = 1.44269504F;
  const float t = std::clamp(x * kLog2E, -126.0F, 0.0F);
  const auto whole = static_cast<std::int32_t>(t - 0.5F);  // Rounds, since t ≤ 0.
  const float f = t - static_cast<float>(whole);
  // Taylor series of 2^f = e^(f ln 2) on [−½, ½]; the next term is 1e-7.
  const float p =
      1.0F + f * (0.693147181F +
                  f * (0.240226507F +
                       f * (0.0555041087F +
                            f * (0.00961812911F + f * (0.00133335581F + f * 0.000154035304F)))));
  return p * std::bit_cast<float>((whole + 127) << 23);
}

/// A quantity at each of the module's wavelengths (sky/atmosphere/spectral_bands.h).
struct alignas(16) Spectrum {
  static constexpr int kSize = 8;
  std::array<float, kSize> v{};

  static Spectrum Of(float value) {
    Spectrum s;
    s.v.fill(value);
    return s;
  }
  Spectrum& operator+=(const Spectrum& o) {
    for (int i = 0; i < kSize; ++i) v[i] += o.v[i];
    return *this;
  }
  Spectrum& operator*=(const Spectrum& o) {
    for (int i = 0; i < kSize; ++i) v[i] *= o.v[i];
    return *this;
  }
  Spectrum& operator*=(float s) {
    for (int i = 0; i < kSize; ++i) v[i] *= s;
    return *this;
  }
  /// *this += o · s.
  void AddScaled(const Spectrum& o, float s) {
    for (int i = 0; i < kSize; ++i) v[i] += o.v[i] * s;
  }
  friend Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
  friend Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
  friend Spectrum operator*(Spectrum a, float s) { return a *= s; }
  friend Spectrum operator-(Spectrum a, const Spectrum& b) {
    for (int i = 0; i < kSize; ++i) a.v[i] -= b.v[i];
    return a;
  }
  friend Spectrum operator/(Spectrum a, const Spectrum& b) {
    for (int i = 0; i < kSize; ++i) a.v[i] /= b.v[i];
    return a;
  }
};

/// e^−x of every element.
inline Spectrum Transmittance(const Spectrum& optical_depth) {
  Spectrum s;
  for (int i = 0; i < Spectrum::kSize; ++i) s.v[i] = ExpOfNegative(-optical_depth.v[i]);
  return s;
}

}  // namespace pleinair::sky
