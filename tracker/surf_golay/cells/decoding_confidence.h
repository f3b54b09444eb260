#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <optional>

#include "tracker/golay/soft_golay_decoder.h"

namespace pleinair::tracker {

/// With fewer numbers in use the required confidence is that for this many, because an image has
/// many places that may match by chance.
constexpr int kMinNumbersForConfidence = 256;

/// Correlation of single pixels with the whole border, occluders included (OrientationTest), that
/// does not occur by chance.
constexpr double kPlainBorder = 0.42;

/// Decoding confidence: bits of evidence for a number, minus the bits needed to select it among
/// `numbers_in_use`.
double ConfidenceBits(const CellLikelihoods& likelihoods, int number, int numbers_in_use);

/// Penalty in bits if the cells match another of all 4,096 markers, in use or not, equally well or
/// better. A few hidden cells rarely make two markers equal by chance, but always do if the other
/// marker is the real one and the cells that differ are hidden.
double AmbiguityBits(const CellLikelihoods& likelihoods, int number,
                     const SoftGolayDecoder& all_numbers);

/// A number in use, decoded under the assumption that a black or white occluder may lie on its
/// cells.
struct CoveredNumber {
  int number = 0;
  double confidence_bits = 0.0;
  /// Bits of evidence above any other number in use, unoccluded or under such an occluder; infinite
  /// if no other number is in use.
  double apart_bits = 0.0;
};

/// The number with the most evidence under the one-occluder assumption (EvidenceUnderCover).
/// Returns nullopt if an unoccluded number has more, if the cells match an unoccluded marker of
/// another number, or if all numbers are in use. `all_numbers`: a decoder of all 4,096 numbers.
std::optional<CoveredNumber> ReadUnderCover(const CellLikelihoods& likelihoods,
                                            const SoftGolayDecoder& numbers_in_use,
                                            const SoftGolayDecoder& all_numbers);

/// Whether these bits suffice for a detection when this share of the marker matches the prediction:
/// the smaller the share, the more bits are required. `border_correlation`: of single pixels, 0 if
/// not computed; a high one lowers the requirement.
bool IsConfident(double confidence_bits, double visible_fraction, double border_correlation);

}  // namespace pleinair::tracker
