#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>

#include "tracker/golay/golay_code.h"

namespace pleinair::tracker {

/// One integer per codeword, in the order of their numbers.
using GolayScores = std::array<std::int32_t, kGolayNumbers>;

/// Correlations of all codewords with the weights: scores[n] = Σ_i ±weights[i], with + where bit i
/// of EncodeGolay(n) is 1. Exact if Σ|weights| < 2³¹.
///
/// The sums are a Walsh–Hadamard transform of the weights placed at the generator's columns: 4,096
/// sums of 24 terms for about 7 additions each. Be'ery & Snyders 1986, Optimal soft decision block
/// decoders based on fast Hadamard transform.
void ScoreGolayWords(const std::array<std::int32_t, kGolayBits>& weights, GolayScores& scores);

/// The largest and the second largest score; equal if two words share the largest.
struct TopTwoScores {
  std::int32_t best = 0;
  std::int32_t second = 0;
};
TopTwoScores FindTopTwo(const GolayScores& scores);

}  // namespace pleinair::tracker
