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
/// top-left without the centre cell: positive = white, 0 = erased (covered, or black and white
/// equally likely). NaN counts as erased; values beyond ±1000 count as ±1000.
using CellLikelihoods = std::array<float, kGolayBits>;

/// What the soft decoder made of 24 cells.
struct SoftGolayDecoding {
  int number = 0;      ///< The likeliest number in use; the lowest of several equally likely ones.
  float score = 0.0F;  ///< Σ ±likelihood, + where a cell agrees with the marker of `number`.
  /// The likeliest other number in use; none where only one is.
  std::optional<int> second_number;
  /// score − the score of `second_number`: twice the summed likelihoods of the cells in which the
  /// two prints differ, and twice their log-likelihood ratio; 0 where they are equally likely,
  /// infinite where no second number is in use.
  float margin = 0.0F;
  /// How far the likeliest number of all 4,096 scores above `number`: positive where the cells look
  /// more like a number that is not in use.
  float shortfall = 0.0F;
  /// score / Σ|likelihood|: 1 where all cells agree, about 0.5 for the best word on random cells; 0
  /// where all are erased.
  float agreement = 0.0F;
  int disagreements = 0;  ///< Cells that look like the other color than `number` has there.
  int erasures = 0;       ///< Cells with likelihood 0.
};

/// Maximum-likelihood decoder of a marker's cells over all numbers in use. Seven erased cells never
/// hide the number when the others are right, and more do not in most cases (of eight, 99.9 %).
/// Decoding costs about a microsecond, allocates nothing, and gives the same result on every
/// processor: likelihoods are rounded to 2⁻¹⁶ and summed as whole numbers.
class SoftGolayDecoder {
 public:
  /// Takes only these numbers for possible; none given means all 4,096 (the state after
  /// construction). Order and repetition do not matter. Errors (input): a number outside 0…4095;
  /// the numbers in use then stay as they were.
  Result<void> SetNumbersInUse(std::span<const int> numbers);

  /// How many different numbers are in use: 1…4096.
  int NumbersInUse() const;
  /// The numbers in use in rising order; none where all 4,096 are.
  std::span<const std::uint16_t> ListedNumbers() const { return numbers_in_use_; }

  SoftGolayDecoding Decode(const CellLikelihoods& cells) const;

  /// The number in use whose marker has these very cells (1 = white); where there is one, Decode of
  /// cells that look so gives it, with a margin of 16 times the least of their likelihoods or more:
  /// prints differ in eight cells at least.
  std::optional<int> NumberOfCells(GolayWord cells) const;

 private:
  std::vector<std::uint16_t> numbers_in_use_;  // Sorted; empty: all.
};

}  // namespace pleinair::tracker
