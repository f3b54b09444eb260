#include "tracker/surf_golay/sg_layout.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {
namespace {

using sg::kBorder;
using sg::kEdge;
using ::testing::Each;
using ::testing::Ge;
using ::testing::SizeIs;

constexpr int kRim = 4, kBand = 5;  ///< Modules.
constexpr int kMinAsymmetry = 150;

struct Module {
  int x, y;
  auto operator<=>(const Module&) const = default;
};
using Modules = std::set<Module>;

/// Modules from the nearest side of the black square.
int FromSide(Module m) { return std::min({m.x, m.y, kEdge - 1 - m.x, kEdge - 1 - m.y}); }

Modules ModulesOf(char color) {
  Modules modules;
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      if (kBorder[y][x] == color) modules.insert({x, y});
    }
  }
  return modules;
}

/// Pieces whose modules share sides or, `diagonally`, corners.
std::vector<Modules> Pieces(Modules left, bool diagonally = false) {
  std::vector<Modules> pieces;
  while (!left.empty()) {
    std::vector<Module> open{*left.begin()};
    left.erase(left.begin());
    Modules piece;
    while (!open.empty()) {
      const Module m = open.back();
      open.pop_back();
      piece.insert(m);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (!diagonally && dx != 0 && dy != 0) continue;
          if (left.erase({m.x + dx, m.y + dy}) > 0) open.push_back({m.x + dx, m.y + dy});
        }
      }
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// Top-left modules of all squares of 2×2 modules within `piece`.
Modules SquaresWithin(const Modules& piece) {
  Modules squares;
  for (const Module m : piece) {
    if (piece.contains({m.x + 1, m.y}) && piece.contains({m.x, m.y + 1}) &&
        piece.contains({m.x + 1, m.y + 1})) {
      squares.insert(m);
    }
  }
  return squares;
}

int LongerSide(const Modules& piece) {
  int x0 = kEdge, x1 = 0, y0 = kEdge, y1 = 0;
  for (const Module m : piece) {
    x0 = std::min(x0, m.x);
    x1 = std::max(x1, m.x);
    y0 = std::min(y0, m.y);
    y1 = std::max(y1, m.y);
  }
  return std::max(x1 - x0, y1 - y0) + 1;
}

TEST(SgLayoutTest, HasWhiteNowhereButInTheBand) {
  for (const Module m : ModulesOf('.')) {
    EXPECT_GE(FromSide(m), kRim) << m.x << ' ' << m.y;
    EXPECT_LT(FromSide(m), kRim + kBand) << m.x << ' ' << m.y;
  }
  EXPECT_THAT(ModulesOf('.').size() + ModulesOf('#').size(), kEdge * kEdge);
}

TEST(SgLayoutTest, HasShapesThatAreNowhereThinnerThanTwoModules) {
  for (const Modules& shape : Pieces(ModulesOf('.'))) {
    const Modules squares = SquaresWithin(shape);
    EXPECT_THAT(Pieces(squares), SizeIs(1)) << shape.begin()->x << ' ' << shape.begin()->y;
    Modules covered;
    for (const Module m : squares) {
      for (int i = 0; i < 4; ++i) covered.insert({m.x + i % 2, m.y + i / 2});
    }
    EXPECT_EQ(covered, shape) << shape.begin()->x << ' ' << shape.begin()->y;
  }
}

TEST(SgLayoutTest, HasBlackBetweenItsShapesEvenAtTheirCorners) {
  EXPECT_EQ(Pieces(ModulesOf('.')), Pieces(ModulesOf('.'), true));
}

TEST(SgLayoutTest, HasBlackOfOnePiece) { EXPECT_THAT(Pieces(ModulesOf('#')), SizeIs(1)); }

TEST(SgLayoutTest, HasShapesAtTwoScalesThatFitIntoTheBand) {
  int large = 0, small = 0;
  for (const Modules& shape : Pieces(ModulesOf('.'))) {
    EXPECT_LE(LongerSide(shape), kBand);
    ++(LongerSide(shape) > 3 ? large : small);
  }
  EXPECT_GE(large, 8);
  EXPECT_GE(small, 4);
}

TEST(SgLayoutTest, LooksOtherwiseTurnedOrMirroredInAnyWay) {
  for (int symmetry = 1; symmetry < 8; ++symmetry) {
    int differing = 0;
    for (int y = 0; y < kEdge; ++y) {
      for (int x = 0; x < kEdge; ++x) {
        int sx = symmetry & 1 ? kEdge - 1 - x : x, sy = symmetry & 2 ? kEdge - 1 - y : y;
        if ((symmetry & 4) != 0) std::swap(sx, sy);
        differing += kBorder[y][x] != kBorder[sy][sx] ? 1 : 0;
      }
    }
    EXPECT_GE(differing, kMinAsymmetry) << "symmetry " << symmetry;
  }
}

TEST(SgLayoutTest, HasNoShapeTwiceAmongTheLargeOnes) {
  std::set<Modules> forms;
  for (const Modules& shape : Pieces(ModulesOf('.'))) {
    if (LongerSide(shape) <= 3) continue;
    int x0 = kEdge, y0 = kEdge;
    for (const Module m : shape) {
      x0 = std::min(x0, m.x);
      y0 = std::min(y0, m.y);
    }
    Modules form;
    for (const Module m : shape) form.insert({m.x - x0, m.y - y0});
    EXPECT_TRUE(forms.insert(form).second) << x0 << ' ' << y0;
  }
}

TEST(SgLayoutTest, SpreadsItsWhiteSoThatAnyHalfHasEnough) {
  const Modules white = ModulesOf('.');
  std::vector<double> shares(8);
  for (std::size_t half = 0; half < shares.size(); ++half) {
    const double angle = std::numbers::pi * static_cast<double>(half) / 4.0;
    for (const Module m : white) {
      const double x = m.x - 0.5 * (kEdge - 1), y = m.y - 0.5 * (kEdge - 1);
      if (x * std::cos(angle) + y * std::sin(angle) > 0.0) {
        shares[half] += 1.0 / static_cast<double>(white.size());
      }
    }
  }
  EXPECT_THAT(shares, Each(Ge(0.42)));
}

TEST(SgMarkerPatternTest, DiffersForEveryNumberAndOnlyInItsCells) {
  std::set<std::string> prints;
  const MarkerPattern first = SgMarkerPattern(0);
  constexpr int kBegin = sg::kQuiet + sg::kContent, kEnd = kBegin + sg::kCells * sg::kCell;
  for (int number = 0; number < 4096; ++number) {
    const MarkerPattern print = SgMarkerPattern(number);
    EXPECT_TRUE(prints.emplace(print.white.begin(), print.white.end()).second) << number;
    for (int y = 0; y < print.modules; ++y) {
      for (int x = 0; x < print.modules; ++x) {
        if (x >= kBegin && x < kEnd && y >= kBegin && y < kEnd) continue;
        ASSERT_EQ(print.white[y * print.modules + x], first.white[y * print.modules + x])
            << number << ": " << x << ' ' << y;
      }
    }
  }
}

TEST(SgMarkerPatternTest, IsTheBorderInAWhiteMargin) {
  const MarkerPattern print = SgMarkerPattern(17);
  ASSERT_EQ(print.modules, 48);
  ASSERT_EQ(print.edge_modules, 40);
  for (int y = 0; y < print.modules; ++y) {
    for (int x = 0; x < print.modules; ++x) {
      const int column = x - sg::kQuiet, row = y - sg::kQuiet;
      const bool margin = column < 0 || row < 0 || column >= kEdge || row >= kEdge;
      if (sg::CellIndex(column) >= 0 && sg::CellIndex(row) >= 0) continue;
      EXPECT_EQ(print.white[y * print.modules + x] != 0, margin || kBorder[row][column] == '.')
          << x << ' ' << y;
    }
  }
}

TEST(SgMarkerPatternTest, TakesAnotherBorderForTheSameWord) {
  sg::Border plain;
  plain.fill("########################################");
  const MarkerPattern print = SgMarkerPatternOfWord(0xFFFFFF, plain);
  int white = 0;
  for (int i = 0; i < print.modules * print.modules; ++i) white += print.white[i];
  constexpr int kMargin = 48 * 48 - 40 * 40, kCells = 25 * 16;
  EXPECT_EQ(white, kMargin + kCells);
}

}  // namespace
}  // namespace pleinair::tracker
