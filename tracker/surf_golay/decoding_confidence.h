#pragma once

// Internal: between the .cc files of this module; not installed.

#include <optional>

#include "tracker/golay/soft_golay_decoder.h"

namespace pleinair::tracker {

/// With few numbers in use as much proof is asked for as with so many: an image holds many places
/// where one may be observed by chance.
constexpr int kMinNumbersForConfidence = 256;

/// Correlation of single pixels with the whole border, covers included (OrientationTest), that no
/// chance gives.
constexpr double kPlainBorder = 0.42;

/// What cells tell for a number beyond picking it out of so many in use, in bits.
double ConfidenceBits(const CellLikelihoods& likelihoods, int number, int numbers_in_use);

/// What it speaks against a number that the cells look as much, or more, like another of all 4,096
/// prints, in use or not, in bits: a few hidden cells leave two prints alike by chance only rarely,
/// but always where the other marker is there and the cells that differ are hidden.
double AmbiguityBits(const CellLikelihoods& likelihoods, int number,
                     const SoftGolayDecoder& all_numbers);

/// A number in use, read where something that looks like ink or paper may lie on its cells.
struct CoveredNumber {
  int number = 0;
  double confidence_bits = 0.0;
  /// How many bits more tell for it than for any other number in use, lying open or under such a
  /// cover; infinite where no other is in use.
  double apart_bits = 0.0;
};

/// The number that all wrong cells under one cover tell most for (EvidenceUnderCover). Nothing
/// where more tells for one that lies open, where the cells look like the marker of another number
/// that does, or where all numbers are in use; `all_numbers`: the decoder of every number, in use
/// or not.
std::optional<CoveredNumber> ReadUnderCover(const CellLikelihoods& likelihoods,
                                            const SoftGolayDecoder& numbers_in_use,
                                            const SoftGolayDecoder& all_numbers);

/// Whether so many bits make a reading a marker where that share of the marker looks as predicted:
/// the less of it does, the more are needed. `border_correlation`: of single pixels, 0 where
/// nobody looked; where it is plain fewer are.
bool IsConfident(double confidence_bits, double visible_fraction, double border_correlation);

}  // namespace pleinair::tracker
