#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "tracker/golay/golay_code.h"

namespace pleinair::tracker {

/// ln(P(observed | white) / P(observed | black)) of the 24 printed cells, row by row from the
/// top-left without the centre cell. Positive: white; 0: erased (occluded, or both colors equally
/// likely). NaN counts as erased; values are clamped to ±1000.
using CellLikelihoods = std::array<float, kGolayBits>;

/// Result of the soft decoder.
struct SoftGolayDecoding {
  int number = 0;      ///< The most likely number in use; the lowest of equally likely ones.
  float score = 0.0F;  ///< Σ ±likelihood, + where a cell agrees with the marker of `number`.
  /// The second most likely number in use; unset if only one is in use.
  std::optional<int> second_number;
  /// Decision margin: score − the score of `second_number`. It is twice their log-likelihood ratio,
  /// which is the sum over the cells in which the two markers differ. 0 if they are equally likely;
  /// infinite without a second number.
  float margin = 0.0F;
  /// Score of the most likely of all 4,096 numbers − score. Positive if the cells match a number
  /// that is not in use better.
  float shortfall = 0.0F;
  /// score / Σ|likelihood|: 1 if all cells agree, about 0.5 for the best word on random cells, 0 if
  /// all cells are erased.
  float agreement = 0.0F;
  int disagreements = 0;  ///< Cells whose observed color differs from that of `number`.
  int erasures = 0;       ///< Cells with likelihood 0.
};

/// Maximum-likelihood decoder of a marker's cells over all numbers in use. With the other cells
/// correct, up to seven erasures are always corrected, and eight in 99.9 % of cases. Decoding takes
/// about a microsecond and allocates nothing. The result is the same on every processor:
/// likelihoods are rounded to 2⁻¹⁶ and summed as integers.
class SoftGolayDecoder {
 public:
  /// Restricts decoding to these numbers; an empty list means all 4,096 (the initial state). Order
  /// and repetition do not matter. Errors (input): a number outside 0…4095; the numbers in use are
  /// then unchanged.
  Result<void> SetNumbersInUse(std::span<const int> numbers);

  /// Count of numbers in use: 1…4096.
  int NumbersInUse() const;
  /// The numbers in use, ascending; empty if all 4,096 are.
  std::span<const std::uint16_t> ListedNumbers() const { return numbers_in_use_; }

  SoftGolayDecoding Decode(const CellLikelihoods& cells) const;

  /// The number in use whose marker has exactly these cells (1 = white). Decode() of such cells
  /// returns the same number, because markers differ in at least eight cells. Its margin is then at
  /// least 16 times the smallest of their likelihoods.
  std::optional<int> NumberOfCells(GolayWord cells) const;

 private:
  std::vector<std::uint16_t> numbers_in_use_;  // Sorted; empty: all.
};

}  // namespace pleinair::tracker
