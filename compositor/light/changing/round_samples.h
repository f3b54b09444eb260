#pragma once

#include <cmath>
#include <cstdint>

#include "compositor/light/sampling.h"

namespace pleinair::compositor {

/// Points for the rays of one round of many, so that all rounds together are even, too. In round r,
/// point i is that of Hammersley's set of `count` points, shifted by
///
///     (a_r / count, b_r),   a_r = frac(r / g),   b_r = frac(r / g²),   g³ = g + 1
///
/// (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences", R2). Each of the
/// `count` columns thus receives this sequence. `seed` shifts all points by the same amount
/// (HammersleyShift()).
class RoundSamples {
 public:
  RoundSamples(std::uint32_t count, std::uint32_t round, std::uint32_t seed)
      : count_(count), shift_(HammersleyShift(seed)) {
    constexpr double kG = 1.32471795724474602596;
    shift_.u += Fraction(round / kG) / count;
    shift_.v += round / (kG * kG);
  }

  SamplePoint operator[](std::uint32_t i) const {
    const SamplePoint at = Hammersley(i, count_);
    return {Fraction(at.u + shift_.u), Fraction(at.v + shift_.v)};
  }

 private:
  static double Fraction(double x) { return x - std::floor(x); }

  std::uint32_t count_;
  SamplePoint shift_;
};

}  // namespace pleinair::compositor
