#include "tracker/surf_golay/cells/decoding_confidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "tracker/golay/golay_code.h"
#include "tracker/surf_golay/cells/cell_evidence.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

/// Share of the marker that matches the prediction, and the confidence its cells must then give
/// beyond the bits that select one of the numbers in use. Chosen on images without markers, with
/// markers of another border and with occluded ones.
struct RequiredConfidence {
  double visible;
  double bits;
};
constexpr std::array<RequiredConfidence, 7> kRequiredConfidence{
    {{0.9, 0.0}, {0.8, 0.7}, {0.7, 1.5}, {0.6, 2.5}, {0.4, 5.0}, {0.3, 5.5}, {0.1, 10.0}}};
/// Occluders may spare few whole blocks while all the pixels of the border together still match.
/// The correlation of the border, pixel by pixel, then lowers the required bits, if
/// kVisibleByBorder of the marker is observed. In 1,050 images without a marker, none of ten
/// readings had a correlation above 0.23 and none had more than 3 bits.
struct ConfidenceByBorder {
  double correlation;
  double bits;
};
constexpr std::array<ConfidenceByBorder, 2> kConfidenceByBorder{{{kPlainBorder, 5.5}, {0.32, 8.0}}};
constexpr double kVisibleByBorder = 0.03;
/// Two numbers are checkerboard patterns, which are common in the world.
constexpr double kCheckeredPenalty_bits = 6.0;
constexpr GolayWord kAllCells = (1U << kGolayBits) - 1;
/// Agreement of the cells with a number, in use or not, above which that marker is certainly the
/// one observed. With one wrong cell of 24 the agreement is 0.917, with two 0.833. A number that
/// differs from it in eight cells of one color is then not read as occluded there; each number has
/// five such others on average.
constexpr float kAnotherLiesOpen = 0.87F;

/// Log-likelihood ratio below which a cell is undecided.
constexpr float kSaysLittle = 1.5F;
/// Decision margin, twice a log-likelihood ratio (SoftGolayDecoding::margin), below which two
/// numbers are ambiguous.
constexpr float kAlikeMargin = 8.0F;
/// -log2 of the probability that 8, 9, … cells drawn at random contain all the cells in which some
/// other marker differs: 759 C(16, n - 8) / C(24, n) up to 11, by the code's 759 words of weight 8.
/// Overlap corrections begin at 12, where the probability is 47 %.
constexpr int kMinDifferingCells = 8;
constexpr std::array<double, 5> kAlikeByChance_bits{9.92, 6.75, 4.43, 2.55, 1.09};

double CheckeredPenaltyBits(int number) {
  const GolayWord marker = CodewordOfNumber(number);
  const bool chequered = marker == kGolayWhitening || (~marker & kAllCells) == kGolayWhitening;
  return chequered ? kCheckeredPenalty_bits : 0.0;
}

}  // namespace

double ConfidenceBits(const CellLikelihoods& likelihoods, int number, int numbers_in_use) {
  return EvidenceBits(likelihoods, number) -
         std::log2(std::max(kMinNumbersForConfidence, numbers_in_use)) -
         CheckeredPenaltyBits(number);
}

double AmbiguityBits(const CellLikelihoods& likelihoods, int number,
                     const SoftGolayDecoder& all_numbers) {
  const SoftGolayDecoding any = all_numbers.Decode(likelihoods);
  if (any.number == number && any.margin >= kAlikeMargin) return 0.0;
  const GolayWord word = CodewordOfNumber(number);
  int hidden = 0;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    const float right = (word >> k & 1U) != 0 ? likelihoods[k] : -likelihoods[k];
    hidden += right < kSaysLittle;
  }
  const std::size_t beyond = std::max(0, hidden - kMinDifferingCells);
  return beyond < kAlikeByChance_bits.size() ? kAlikeByChance_bits[beyond] : 0.0;
}

std::optional<CoveredNumber> ReadUnderCover(const CellLikelihoods& likelihoods,
                                            const SoftGolayDecoder& numbers_in_use,
                                            const SoftGolayDecoder& all_numbers) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const EvidenceUnderCover under_cover(likelihoods);
  int best_number = 0;
  bool covered = false;
  double best = kNone, second = kNone;
  for (const int number : numbers_in_use.ListedNumbers()) {
    const double open = EvidenceBits(likelihoods, number);
    const double hidden = under_cover.Bits(number).value_or(kNone);
    const double bits = std::max(open, hidden);
    second = std::max(second, std::min(best, bits));
    if (bits <= best) continue;
    best = bits;
    best_number = number;
    covered = hidden > open;
  }
  if (!covered || all_numbers.Decode(likelihoods).agreement > kAnotherLiesOpen) return std::nullopt;
  return CoveredNumber{
      best_number,
      best - std::log2(numbers_in_use.NumbersInUse()) - CheckeredPenaltyBits(best_number),
      best - second};
}

bool IsConfident(double confidence_bits, double visible_fraction, double border_correlation) {
  const bool by_border = visible_fraction >= kVisibleByBorder &&
                         std::any_of(kConfidenceByBorder.begin(), kConfidenceByBorder.end(),
                                     [&](const ConfidenceByBorder& required) {
                                       return border_correlation >= required.correlation &&
                                              confidence_bits >= required.bits;
                                     });
  return by_border || std::any_of(kRequiredConfidence.begin(), kRequiredConfidence.end(),
                                  [&](const RequiredConfidence& required) {
                                    return visible_fraction >= required.visible &&
                                           confidence_bits >= required.bits;
                                  });
}

}  // namespace pleinair::tracker
