#include "tracker/surf_golay/cell_evidence.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "tracker/golay/golay_code.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

/// What a wrong cell under a cover that is there takes off: half of the cells there are right.
constexpr double kUnderCover_bits = -1.0;

double CellBits(float likelihood, bool printed_white) {
  const double right = printed_white ? likelihood : -likelihood;
  return 1.0 - std::log2(1.0 + std::exp(-right));
}

/// The cells of a set that hang together with one of them, corners included.
std::uint32_t HangingTogether(std::uint32_t cells, int from) {
  std::uint32_t reached = 1U << from;
  for (bool more = true; more;) {
    more = false;
    for (int k = 0; k < sg::kCodeCells; ++k) {
      if ((cells >> k & 1U) == 0 || (reached >> k & 1U) != 0) continue;
      for (int other = 0; other < sg::kCodeCells; ++other) {
        if ((reached >> other & 1U) == 0) continue;
        if (std::abs(sg::CodeCellColumn(other) - sg::CodeCellColumn(k)) > 1 ||
            std::abs(sg::CodeCellRow(other) - sg::CodeCellRow(k)) > 1) {
          continue;
        }
        reached |= 1U << k;
        more = true;
        break;
      }
    }
  }
  return reached;
}

}  // namespace

double EvidenceBits(const CellLikelihoods& likelihoods, int number) {
  const GolayWord word = PrintedWord(number);
  double bits = 0.0;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    bits += CellBits(likelihoods[k], (word >> k & 1U) != 0);
  }
  return bits;
}

std::optional<double> EvidenceBitsUnderCover(const CellLikelihoods& likelihoods, int number) {
  const GolayWord word = PrintedWord(number);
  std::uint32_t looks_white = 0, looks_black = 0, wrong = 0;
  double bits = 0.0, dearest = 0.0;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    const bool printed_white = (word >> k & 1U) != 0;
    if (likelihoods[k] > 0.0F) looks_white |= 1U << k;
    if (likelihoods[k] < 0.0F) looks_black |= 1U << k;
    const double cell = CellBits(likelihoods[k], printed_white);
    if (printed_white ? likelihoods[k] < 0.0F : likelihoods[k] > 0.0F) {
      wrong |= 1U << k;
      // The dearest is paid for in full, the others as a cover's.
      const double other = std::max(dearest, cell);
      dearest = std::min(dearest, cell);
      bits += std::max(kUnderCover_bits, other);
    } else {
      bits += cell;
    }
  }
  if (std::popcount(wrong) < 2) return std::nullopt;
  const int first = std::countr_zero(wrong);
  const std::uint32_t alike = (looks_white >> first & 1U) != 0 ? looks_white : looks_black;
  if ((wrong & ~HangingTogether(alike, first)) != 0) return std::nullopt;
  return bits + dearest;
}

}  // namespace pleinair::tracker
