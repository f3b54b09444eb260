#include "tracker/surf_golay/cells/cell_evidence.h"

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

/// Deduction for a wrong cell under an occluder that is present: half of the cells there match.
constexpr double kUnderCover_bits = -1.0;

double CellBits(float likelihood, bool white_in_code) {
  const double right = white_in_code ? likelihood : -likelihood;
  return 1.0 - std::log2(1.0 + std::exp(-right));
}

/// Deduction if a cell that is clearly of the other color lies straight between two occluded cells:
/// few occluders have holes there.
constexpr double kSeenBetween_bits = 2.0;

/// The cells of a set that are connected to one of them, diagonally too.
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

/// Whether the straight line between the centres of two cells passes near the centre of a third:
/// within 0.36 of a cell's side. An occluder of both then hides most of the third.
constexpr bool LiesBetween(int cell, int one, int other) {
  const int along_x = sg::CodeCellColumn(other) - sg::CodeCellColumn(one);
  const int along_y = sg::CodeCellRow(other) - sg::CodeCellRow(one);
  const int to_x = sg::CodeCellColumn(cell) - sg::CodeCellColumn(one);
  const int to_y = sg::CodeCellRow(cell) - sg::CodeCellRow(one);
  const int length2 = along_x * along_x + along_y * along_y;
  const int along = along_x * to_x + along_y * to_y, beside = along_x * to_y - along_y * to_x;
  return along > 0 && along < length2 && 100 * beside * beside < 13 * length2;
}

using CellsBetween = std::array<std::array<std::uint32_t, sg::kCodeCells>, sg::kCodeCells>;
constexpr CellsBetween FindCellsBetween() {
  CellsBetween between{};
  for (int one = 0; one < sg::kCodeCells; ++one) {
    for (int other = 0; other < sg::kCodeCells; ++other) {
      for (int cell = 0; cell < sg::kCodeCells; ++cell) {
        if (LiesBetween(cell, one, other)) between[one][other] |= 1U << cell;
      }
    }
  }
  return between;
}
constexpr CellsBetween kBetween = FindCellsBetween();

}  // namespace

double EvidenceBits(const CellLikelihoods& likelihoods, int number) {
  const GolayWord word = CodewordOfNumber(number);
  double bits = 0.0;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    bits += CellBits(likelihoods[k], (word >> k & 1U) != 0);
  }
  return bits;
}

EvidenceUnderCover::EvidenceUnderCover(const CellLikelihoods& likelihoods) {
  for (int k = 0; k < sg::kCodeCells; ++k) {
    white_bits_[k] = CellBits(likelihoods[k], true);
    black_bits_[k] = CellBits(likelihoods[k], false);
    if (likelihoods[k] > 0.0F) appears_white_ |= 1U << k;
    if (likelihoods[k] < 0.0F) appears_black_ |= 1U << k;
  }
  for (const CellSet alike : {appears_white_, appears_black_}) {
    for (CellSet left = alike; left != 0;) {
      const CellSet together = HangingTogether(alike, std::countr_zero(left));
      for (CellSet cells = together; cells != 0; cells &= cells - 1) {
        together_[std::countr_zero(cells)] = together;
      }
      left &= ~together;
    }
  }
}

std::optional<double> EvidenceUnderCover::Bits(int number) const {
  const GolayWord word = CodewordOfNumber(number);
  const CellSet wrong = (appears_white_ & ~word) | (appears_black_ & word);
  if (std::popcount(wrong) < 2 || (wrong & ~together_[std::countr_zero(wrong)]) != 0) {
    return std::nullopt;
  }
  double bits = 0.0, dearest = 0.0;
  CellSet between = 0;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    const double cell = (word >> k & 1U) != 0 ? white_bits_[k] : black_bits_[k];
    if ((wrong >> k & 1U) == 0) {
      bits += cell;
      continue;
    }
    // The most improbable cell counts in full, the others as occluded.
    bits += std::max(kUnderCover_bits, std::max(dearest, cell));
    dearest = std::min(dearest, cell);
    for (CellSet others = wrong >> k >> 1 << k << 1; others != 0; others &= others - 1) {
      between |= kBetween[k][std::countr_zero(others)];
    }
  }
  const bool white_cover = (wrong & appears_white_) != 0;
  for (CellSet cells = between & (white_cover ? appears_black_ : appears_white_); cells != 0;
       cells &= cells - 1) {
    const int k = std::countr_zero(cells);
    // Weighted by how clear the cell is.
    bits -= kSeenBetween_bits * std::max(0.0, white_cover ? black_bits_[k] : white_bits_[k]);
  }
  return bits + dearest;
}

}  // namespace pleinair::tracker
