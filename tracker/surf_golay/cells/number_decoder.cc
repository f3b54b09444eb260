#include "tracker/surf_golay/cells/number_decoder.h"

#include <numbers>

#include "tracker/surf_golay/cells/cell_split.h"
#include "tracker/surf_golay/cells/decoding_confidence.h"

namespace pleinair::tracker {
namespace {

/// How much likelier than the next the number of a marker must be, in nats.
constexpr float kMinMargin = 8.0F;
/// Wrong cells from which on something may cover them, how much more must tell for a number that is
/// read beneath it than for the next, and what a bit is as a margin (SoftGolayDecoding::margin).
constexpr int kMinHidden = 2;
constexpr double kMinApart_bits = 8.0, kMarginPerBit = 2.0 * std::numbers::ln2;
/// Share of the border that tells the light over the whole marker; and what it takes off a proof
/// that the cells themselves had to tell it.
constexpr double kVisibleForLight = 0.8, kSplitPenalty_bits = 2.0;
/// The same where so much of the border shows a light without clipping and edges of shadows: cells
/// that part otherwise contradict it, and what covers half of them has a color of its own.
constexpr double kShowsLight = 0.5, kSplitAgainstLight_bits = 6.0;
/// What glare takes off the proof where the border is plainly a marker's: nothing lies on the cells
/// that it drowns, so that twelve plain ones are enough, and the blocks that it touches look less
/// like the marker without being covered.
constexpr double kDrowned_bits = 1.0;
constexpr double kShowsGlare = 0.3;  ///< Share of the border that makes glare worth solving for.

}  // namespace

std::optional<DecodedNumber> NumberDecoder::Decode(const MarkerPattern& blank,
                                                   const FittedPatch& border,
                                                   const BlockFitState& state,
                                                   double visible_border) {
  std::optional<DecodedNumber> best;
  const auto decode = [&](const CellLikelihoods& likelihoods, double penalty_bits,
                          const CellLikelihoods* by_light = nullptr) {
    const SoftGolayDecoding decoding = in_use_.Decode(likelihoods);
    const auto take = [&](int number, float margin, double bits) {
      if (margin < kMinMargin || (best && bits <= best->confidence_bits)) return;
      best = {number, margin, bits};
    };
    // A number in use must not be one that many others would beat.
    take(decoding.number, decoding.margin - decoding.shortfall,
         ConfidenceBits(likelihoods, decoding.number, in_use_.NumbersInUse()) - penalty_bits -
             AmbiguityBits(by_light != nullptr ? *by_light : likelihoods, decoding.number,
                           any_number_));
    if (visible_border < kVisibleForLight || decoding.disagreements < kMinHidden ||
        in_use_.NumbersInUse() > kMinNumbersForConfidence) {
      return;
    }
    // Plainly a marker, and of the few that it can be one alone, if something that looks like ink
    // or paper lies on it.
    const auto covered = ReadUnderCover(likelihoods, in_use_, any_number_);
    if (covered && covered->apart_bits >= kMinApart_bits) {
      take(covered->number, static_cast<float>(kMarginPerBit * covered->apart_bits),
           covered->confidence_bits - penalty_bits);
    }
  };
  // Several explanations of the light; the one that proves its number best is taken.
  for (const bool brightest : {false, true}) {
    MarkerLight light;
    if (!light_estimator_.Measure(blank, border.fit, border.observed, brightest, &light)) break;
    CellReading cells;
    cell_reader_.ReadCells(blank, border.fit, border.observed, state, light, false, &cells);
    decode(cells.likelihoods, 0.0);
    if (best && best->margin > kSafeMargin) break;
    // Where the border shows the light well, a cell that is neither black nor white is covered.
    if (visible_border < kVisibleForLight || light.white_clips || light.edge) {
      const bool against_light = visible_border > kShowsLight && !light.white_clips && !light.edge;
      const CellSplits splits = SplitCells(cells);
      for (int i = 0; i < splits.count; ++i) {
        if (against_light) {
          // What the light says is covered leaves open which of two prints lies there.
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
