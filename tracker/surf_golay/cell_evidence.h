#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <optional>

#include "tracker/golay/soft_golay_decoder.h"

namespace pleinair::tracker {

/// How many bits the cells tell for a number over cells that are drawn at random: one each where
/// all are plain and right, much less than none where one is plainly wrong.
double EvidenceBits(const CellLikelihoods& likelihoods, int number);

/// The same where all that is wrong may lie under one thing that looks like ink, or like paper: the
/// wrong cells look alike and hang together by cells that look like them. One of them is as
/// unlikely as it looks; of the others under the same cover each second one is bound to be wrong.
/// A cell between them that plainly looks otherwise speaks against the cover.
class EvidenceUnderCover {
 public:
  explicit EvidenceUnderCover(const CellLikelihoods& likelihoods);

  /// Bits for a number; nothing where less than two cells are wrong, or not in this way.
  std::optional<double> Bits(int number) const;

 private:
  using CellSet = std::uint32_t;  ///< A bit a cell.

  std::array<double, kGolayBits> white_bits_, black_bits_;  ///< Of cells that are printed so.
  CellSet appears_white_ = 0, appears_black_ = 0;
  /// The cells that look like each and hang together with it, itself as well.
  std::array<CellSet, kGolayBits> together_{};
};

}  // namespace pleinair::tracker
