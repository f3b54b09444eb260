#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <optional>

#include "tracker/golay/soft_golay_decoder.h"

namespace pleinair::tracker {

/// Log-likelihood ratio, in bits, of a number against random cells: about one bit per clear and
/// correct cell, much less than none if a clear cell contradicts the number.
double EvidenceBits(const CellLikelihoods& likelihoods, int number);

/// The same under the assumption that all contradicting cells lie under one occluder, black or
/// white: they have the same color and are connected through cells of that color. One of them
/// counts with its full improbability; each other cell under the same occluder contradicts with
/// probability ½. A cell between them with clearly the other color refutes the occluder.
class EvidenceUnderCover {
 public:
  explicit EvidenceUnderCover(const CellLikelihoods& likelihoods);

  /// Bits for a number; nullopt if fewer than two cells contradict it, or not in this way.
  std::optional<double> Bits(int number) const;

 private:
  using CellSet = std::uint32_t;  ///< One bit per cell.

  std::array<double, kGolayBits> white_bits_, black_bits_;  ///< Of cells that are printed white or
                                                            ///< black.
  CellSet appears_white_ = 0, appears_black_ = 0;
  /// For each cell, the cells of its color that are connected to it, itself included.
  std::array<CellSet, kGolayBits> together_{};
};

}  // namespace pleinair::tracker
