#pragma once

// Internal: between the .cc files of this module; not installed.

#include <optional>
#include <span>

#include "base/error.h"
#include "tracker/golay/soft_golay_decoder.h"
#include "tracker/surf_golay/cell_light.h"
#include "tracker/surf_golay/cell_reader.h"
#include "tracker/surf_golay/fitted_patch.h"

namespace pleinair::tracker {

/// A number that the cells of a marker show.
struct DecodedNumber {
  int number = 0;
  float margin = 0.0F;           ///< Over the next likely one, in nats (SoftGolayDecoding::margin).
  double confidence_bits = 0.0;  ///< Beyond picking one of the numbers in use.
};

/// Decodes the number of a marker whose border was fitted: estimates its light, reads the cells,
/// and decodes them as they are, as two groups, and under a cover. Keeps its buffers; one thread at
/// a time.
class NumberDecoder {
 public:
  /// Margin above which a number needs no other explanation of the light, in nats.
  static constexpr float kSafeMargin = 25.0F;

  /// Errors (input): a number outside 0…4095; none given means all.
  Result<void> SetNumbersInUse(std::span<const int> numbers) {
    return in_use_.SetNumbersInUse(numbers);
  }
  const SoftGolayDecoder& in_use() const { return in_use_; }

  /// `border`: the fit of the marker `blank` (SgPatterns) at `state`; `visible_border`: share of
  /// the border that looks as predicted. Nothing where the cells show no number.
  std::optional<DecodedNumber> Decode(const MarkerPattern& blank, const FittedPatch& border,
                                      const BlockFitState& state, double visible_border);

 private:
  SoftGolayDecoder in_use_;
  SoftGolayDecoder any_number_;  ///< Of all 4,096, in use or not.
  MarkerLightEstimator light_estimator_;
  CellReader cell_reader_;
};

}  // namespace pleinair::tracker
