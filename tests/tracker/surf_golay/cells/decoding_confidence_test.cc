// Tests whether the observed cells prove a number.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "tests/tracker/surf_golay/sg_test_scenes.h"
#include "tracker/golay/golay_code.h"
#include "tracker/surf_golay/cells/cell_evidence.h"
#include "tracker/surf_golay/cells/decoding_confidence.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {
namespace {

constexpr int kNumber = 2741;

TEST(DecodingConfidence, ProveANumberUnderOneCoverButNotUnderScatteredErrors) {
  const GolayWord word = CodewordOfNumber(kNumber);
  const auto white = [&](int k) { return (word >> k & 1U) != 0; };
  CellLikelihoods plain{};
  for (int k = 0; k < sg::kCodeCells; ++k) plain[k] = white(k) ? 5.0F : -5.0F;
  EXPECT_NEAR(EvidenceBits(plain, kNumber), 24.0, 0.3);
  EXPECT_FALSE(EvidenceUnderCover(plain).Bits(kNumber));

  // An ink-colored bar over the two uppermost rows.
  CellLikelihoods barred = plain;
  int hidden = 0;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    if (sg::CodeCellRow(k) > 1) continue;
    hidden += white(k);
    barred[k] = -5.0F;
  }
  ASSERT_GE(hidden, 3);
  const auto under_cover = EvidenceUnderCover(barred).Bits(kNumber);
  ASSERT_TRUE(under_cover);
  // The first wrong cell at full cost (5 nats are 7.2 bits), one bit for each further cell.
  EXPECT_NEAR(*under_cover, 24.0 - hidden + 1.0 - 7.2 - (hidden - 1), 0.3);
  EXPECT_LT(EvidenceBits(barred, kNumber), *under_cover - 4.0);

  // The same with one more white cell, or with isolated wrong cells.
  CellLikelihoods both = barred;
  for (int k = 23; k > 12; --k) {
    if (white(k)) continue;
    both[k] = 5.0F;
    break;
  }
  EXPECT_FALSE(EvidenceUnderCover(both).Bits(kNumber));
  CellLikelihoods apart{};
  for (int k = 0; k < sg::kCodeCells; ++k) apart[k] = -0.0F;
  apart[sg::CodeCell(0, 0)] = white(sg::CodeCell(0, 0)) ? -5.0F : 5.0F;
  const bool same = white(sg::CodeCell(4, 4)) == white(sg::CodeCell(0, 0));
  const int far = same ? sg::CodeCell(4, 4) : sg::CodeCell(4, 0);
  apart[far] = white(far) ? -5.0F : 5.0F;
  EXPECT_FALSE(EvidenceUnderCover(apart).Bits(kNumber));
}

/// Cells of a marker, `likelihood` nats each, under an ink-colored or paper-colored cover. It hides
/// a cell completely where `hides` is 1. A half-covered cell is undecided unless cover and cell
/// have the same color.
CellLikelihoods CellsUnder(int number, const std::function<double(int)>& hides, bool paper,
                           float likelihood = 6.0F) {
  CellLikelihoods cells;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    const double hidden = hides(k);
    const bool white = IsWhite(number, k);
    if (hidden > 0.9) {
      cells[k] = paper ? likelihood : -likelihood;
    } else if (hidden > 0.1 && white != paper) {
      cells[k] = 0.0F;
    } else {
      cells[k] = white ? likelihood : -likelihood;
    }
  }
  return cells;
}

TEST(DecodingConfidence, LeaveOpenWhichOfTwoNumbersLiesUnderACoverThatBothExplain) {
  // Ink over the two left columns and half of the third. It covers five white cells of 361. For
  // 1609 only three of its white cells would be under it, but they lie around a corner.
  const CellLikelihoods cells = CellsUnder(
      361,
      [](int k) {
        const int column = sg::CodeCellColumn(k);
        return column < 2 ? 1.0 : column == 2 && sg::CodeCellRow(k) > 1 ? 0.5 : 0.0;
      },
      false);
  SoftGolayDecoder in_use;
  ASSERT_TRUE(in_use.SetNumbersInUse(std::vector<int>{361, 1609, 1514}));
  // Cell by cell, the wrong number is e^12 times more likely.
  EXPECT_EQ(in_use.Decode(cells).number, 1609);
  EXPECT_GT(in_use.Decode(cells).margin, 16.0F);
  const auto read = ReadUnderCover(cells, in_use, SoftGolayDecoder());
  EXPECT_LT(read ? read->apart_bits : 0.0, 8.0);
  ASSERT_TRUE(in_use.SetNumbersInUse(std::vector<int>{361, 1514}));
  const auto alone = ReadUnderCover(cells, in_use, SoftGolayDecoder());
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->number, 361);
  EXPECT_GT(alone->apart_bits, 8.0);
}

TEST(DecodingConfidence, GiveUnderBarsAndBlobsTheNumberThatIsThere) {
  std::mt19937 random(17);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int right = 0, wrong = 0, likeliest = 0, drawn = 0;
  while (drawn < 2000) {
    // Bars and blobs that hide five to twelve cells.
    const double angle = draw(0.0, std::numbers::pi), x = draw(-2.0, 2.0), y = draw(-2.0, 2.0);
    const bool bar = random() % 2 == 0, paper = random() % 2 == 0;
    const double half = bar ? draw(0.6, 1.6) : draw(1.2, 2.4);
    const auto hides = [&](int k) {
      const double dx = sg::CodeCellColumn(k) - 2 - x, dy = sg::CodeCellRow(k) - 2 - y;
      const double away =
          bar ? std::fabs(dx * std::cos(angle) + dy * std::sin(angle)) : std::hypot(dx, dy);
      return std::clamp(half - away + 0.5, 0.0, 1.0);
    };
    int hidden = 0;
    for (int k = 0; k < sg::kCodeCells; ++k) hidden += hides(k) > 0.9;
    if (hidden < 5 || hidden > 12) continue;
    ++drawn;
    std::vector<int> numbers(50);
    for (int& number : numbers) number = static_cast<int>(random() % kGolayNumbers);
    SoftGolayDecoder in_use;
    ASSERT_TRUE(in_use.SetNumbersInUse(numbers));
    const CellLikelihoods cells = CellsUnder(numbers[0], hides, paper);
    likeliest += in_use.Decode(cells).number == numbers[0];
    const auto read = ReadUnderCover(cells, in_use, SoftGolayDecoder());
    if (!read || read->apart_bits < 8.0) continue;
    (read->number == numbers[0] ? right : wrong) += 1;
  }
  RecordProperty("right", right);
  RecordProperty("wrong", wrong);
  RecordProperty("likeliest_cell_by_cell", likeliest);
  // At most 2^-8 of the accepted results may be wrong.
  EXPECT_LE(wrong, right / 256);
  EXPECT_GT(right, drawn / 2);
}

}  // namespace
}  // namespace pleinair::tracker
