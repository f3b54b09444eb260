#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <optional>
#include <span>

#include "base/error.h"
#include "tracker/golay/soft_golay_decoder.h"
#include "tracker/surf_golay/cells/cell_light.h"
#include "tracker/surf_golay/cells/cell_reader.h"
#include "tracker/surf_golay/fitted_patch.h"

namespace pleinair::tracker {

/// A number decoded from the cells of a marker.
struct DecodedNumber {
  int number = 0;
  float margin = 0.0F;           ///< Decision margin over the second number, in nats
                                 ///< (SoftGolayDecoding::margin).
  double confidence_bits = 0.0;  ///< Beyond the bits to select one of the numbers in use.
};

/// Decodes the number of a marker whose border was fitted: estimates the light, estimates the
/// cells, and decodes them directly, as two groups (CellSplits), and under an occluder. Reuses its
/// buffers; one thread at a time.
class NumberDecoder {
 public:
  /// Margin, in nats, above which no alternative light is tried.
  static constexpr float kSafeMargin = 25.0F;

  /// Errors (input): a number outside 0…4095. An empty list means all.
  Result<void> SetNumbersInUse(std::span<const int> numbers) {
    return in_use_.SetNumbersInUse(numbers);
  }
  const SoftGolayDecoder& in_use() const { return in_use_; }

  /// `border`: fit of the pattern `blank` (SgPatterns) at `state`; `visible_border`: share of the
  /// border that matches the prediction. Returns nullopt if the cells show no number.
  std::optional<DecodedNumber> Decode(const MarkerPattern& blank, const FittedPatch& border,
                                      const BlockFitState& state, double visible_border);

  /// Whether the cells show a number that is not in use. False if all numbers are in use.
  bool ShowAnotherNumber(const MarkerPattern& blank, const FittedPatch& border,
                         const BlockFitState& state, double visible_border);

 private:
  std::optional<DecodedNumber> DecodeAmong(const SoftGolayDecoder& numbers,
                                           const MarkerPattern& blank, const FittedPatch& border,
                                           const BlockFitState& state, double visible_border);

  SoftGolayDecoder in_use_;
  SoftGolayDecoder any_number_;  ///< Decoder of all 4,096 numbers.
  MarkerLightEstimator light_estimator_;
  CellReader cell_reader_;
};

}  // namespace pleinair::tracker
