#pragma once
// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstdint>

#include "tracker/golay/golay_code.h"

namespace pleinair::tracker {

/// One whole number per codeword, in the order of their numbers.
using GolayScores = std::array<std::int32_t, kGolayNumbers>;

/// scores[n] = Σ_i ±weights[i], plus where bit i of EncodeGolay(n) is 1: the correlation of all
/// words with the weights, exact as long as Σ|weights| < 2³¹.
///
/// The sums are a Walsh–Hadamard transform of the weights placed at the generator's columns (Be'ery
/// & Snyders 1986, Optimal soft decision block decoders based on fast Hadamard transform): 4,096
/// sums of 24 terms for about 7 additions each.
void ScoreGolayWords(const std::array<std::int32_t, kGolayBits>& weights, GolayScores& scores);

/// The largest score and the second largest, which equals it where two words share the largest.
struct TopTwoScores {
  std::int32_t best = 0;
  std::int32_t second = 0;
};
TopTwoScores FindTopTwo(const GolayScores& scores);

}  // namespace pleinair::tracker
