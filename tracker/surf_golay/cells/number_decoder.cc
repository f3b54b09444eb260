#include "tracker/surf_golay/cells/number_decoder.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <span>

#include "tracker/surf_golay/cells/cell_split.h"
#include "tracker/surf_golay/cells/decoding_confidence.h"

namespace pleinair::tracker {
namespace {

/// Minimum decision margin of a marker's number over the second, in nats.
constexpr float kMinMargin = 8.0F;
/// Minimum number of wrong cells that an occluder may explain; minimum evidence for a number read
/// under an occluder beyond the second; a bit as a margin (SoftGolayDecoding::margin).
constexpr int kMinHidden = 2;
constexpr double kMinApart_bits = 8.0, kMarginPerBit = 2.0 * std::numbers::ln2;
/// Visible share of the border that determines the light of the whole marker; deduction from the
/// confidence if the cells had to determine it instead.
constexpr double kVisibleForLight = 0.8, kSplitPenalty_bits = 2.0;
/// Visible share of the border that shows a light without clipping and shadow edges. A split of the
/// cells then contradicts that light, and an occluder of half of the cells has a color of its own,
/// so more bits are deducted.
constexpr double kShowsLight = 0.5, kSplitAgainstLight_bits = 6.0;
/// Added to the confidence under glare if the border clearly is a marker's. Nothing lies on the
/// cells that glare saturates, so twelve plain cells suffice. The blocks in glare match the marker
/// less well without being occluded.
constexpr double kDrowned_bits = 1.0;
constexpr double kShowsGlare = 0.3;  ///< Minimum visible share of the border for solving for glare.

}  // namespace

std::optional<DecodedNumber> NumberDecoder::Decode(const MarkerPattern& blank,
                                                   const FittedPatch& border,
                                                   const BlockFitState& state,
                                                   double visible_border) {
  return DecodeAmong(in_use_, blank, border, state, visible_border);
}

bool NumberDecoder::ShowAnotherNumber(const MarkerPattern& blank, const FittedPatch& border,
                                      const BlockFitState& state, double visible_border) {
  const std::span<const std::uint16_t> in_use = in_use_.ListedNumbers();
  if (in_use.empty()) return false;
  const auto any = DecodeAmong(any_number_, blank, border, state, visible_border);
  return any && IsConfident(any->confidence_bits, visible_border, 0.0) &&
         !std::ranges::binary_search(in_use, any->number);
}

std::optional<DecodedNumber> NumberDecoder::DecodeAmong(const SoftGolayDecoder& numbers,
                                                        const MarkerPattern& blank,
                                                        const FittedPatch& border,
                                                        const BlockFitState& state,
                                                        double visible_border) {
  std::optional<DecodedNumber> best;
  const auto decode = [&](const CellLikelihoods& likelihoods, double penalty_bits,
                          const CellLikelihoods* by_light = nullptr) {
    const SoftGolayDecoding decoding = numbers.Decode(likelihoods);
    const auto take = [&](int number, float margin, double bits) {
      if (margin < kMinMargin || (best && bits <= best->confidence_bits)) return;
      best = {number, margin, bits};
    };
    // The decision margin is reduced if many numbers that are not in use match better.
    take(decoding.number, decoding.margin - decoding.shortfall,
         ConfidenceBits(likelihoods, decoding.number, numbers.NumbersInUse()) - penalty_bits -
             AmbiguityBits(by_light != nullptr ? *by_light : likelihoods, decoding.number,
                           any_number_));
    if (visible_border < kVisibleForLight || decoding.disagreements < kMinHidden ||
        numbers.NumbersInUse() > kMinNumbersForConfidence) {
      return;
    }
    // The border clearly is a marker's, and only one of the few possible numbers fits if something
    // like ink or paper lies on it.
    const auto covered = ReadUnderCover(likelihoods, numbers, any_number_);
    if (covered && covered->apart_bits >= kMinApart_bits) {
      take(covered->number, static_cast<float>(kMarginPerBit * covered->apart_bits),
           covered->confidence_bits - penalty_bits);
    }
  };
  // There are several explanations of the light; the one with the most confident number wins.
  for (const bool brightest : {false, true}) {
    MarkerLight light;
    if (!light_estimator_.Measure(blank, border.fit, border.observed, brightest, &light)) break;
    CellReading cells;
    cell_reader_.ReadCells(blank, border.fit, border.observed, state, light, false, &cells);
    decode(cells.likelihoods, 0.0);
    if (best && best->margin > kSafeMargin) break;
    // Where the border shows the light well, a cell that is neither black nor white is occluded.
    if (visible_border < kVisibleForLight || light.white_clips || light.edge) {
      const bool against_light = visible_border > kShowsLight && !light.white_clips && !light.edge;
      const CellSplits splits = SplitCells(cells);
      for (int i = 0; i < splits.count; ++i) {
        if (against_light) {
          // Cells that are occluded under that light do not decide between two markers.
          decode(splits.likelihoods[i], kSplitAgainstLight_bits, &cells.likelihoods);
        } else {
          decode(splits.likelihoods[i], kSplitPenalty_bits);
        }
      }
    }
    if (!cells.glaring || visible_border < kShowsGlare) continue;
    if (best && best->margin > kSafeMargin) break;
    cell_reader_.ReadCells(blank, border.fit, border.observed, state, light, true, &cells);
    decode(cells.likelihoods, visible_border < kVisibleForLight ? 0.0 : -kDrowned_bits);
  }
  return best;
}

}  // namespace pleinair::tracker
