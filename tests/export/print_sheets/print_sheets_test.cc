// Tests the parts of print sheets: outlines, pages, layout, images.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/commands/marker_command.h"
#include "base/srgb.h"
#include "export/print_sheets/board_description.h"
#include "export/print_sheets/marker_sheet.h"
#include "export/print_sheets/print_outline.h"
#include "export/print_sheets/sheet.h"
#include "export/print_sheets/sheet_raster.h"
#include "export/print_sheets/square_board.h"
#include "tracker/surf_golay/sg_layout.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::exports {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
namespace sg = tracker::sg;

tracker::MarkerPattern PatternOf(const std::vector<std::string>& rows) {
  tracker::MarkerPattern pattern;
  pattern.modules = pattern.edge_modules = static_cast<int>(rows.size());
  for (const std::string& row : rows) {
    for (const char c : row) pattern.white.push_back(c == '.' ? 1 : 0);
  }
  return pattern;
}

/// Even-odd rule at a module's centre: number of edges that a ray to the left crosses.
bool FilledAt(const std::vector<std::vector<ModuleCorner>>& loops, int x, int y) {
  int crossings = 0;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const ModuleCorner a = loop[i], b = loop[(i + 1) % loop.size()];
      const bool spans = std::min(a.y, b.y) <= y && y < std::max(a.y, b.y);
      if (a.x == b.x && a.x <= x && spans) ++crossings;
    }
  }
  return crossings % 2 == 1;
}

TEST(PrintOutline, FillsExactlyTheBlackModulesOfRandomPatterns) {
  std::mt19937 random(1);
  for (int round = 0; round < 100; ++round) {
    tracker::MarkerPattern pattern;
    pattern.modules = pattern.edge_modules = 1 + round % 17;
    std::bernoulli_distribution white(0.1 + 0.8 * (round % 7) / 6.0);
    for (int i = 0; i < pattern.modules * pattern.modules; ++i) {
      pattern.white.push_back(white(random) ? 1 : 0);
    }
    const auto loops = TraceBlackOutlines(pattern);
    for (const auto& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const ModuleCorner a = loop[i], b = loop[(i + 1) % loop.size()],
                           c = loop[(i + 2) % loop.size()];
        // Axis-parallel edges, with a turn at each corner.
        ASSERT_NE(a.x == b.x, a.y == b.y);
        ASSERT_NE(a.x == b.x, b.x == c.x);
      }
    }
    for (int y = 0; y < pattern.modules; ++y) {
      for (int x = 0; x < pattern.modules; ++x) {
        ASSERT_EQ(FilledAt(loops, x, y), pattern.white[y * pattern.modules + x] == 0)
            << "round " << round << " at " << x << ", " << y;
      }
    }
  }
}

TEST(PrintOutline, OfARingIsTwoLoops) {
  EXPECT_THAT(TraceBlackOutlines(PatternOf({"###", "#.#", "###"})),
              ElementsAre(SizeIs(4), SizeIs(4)));
}

TEST(PrintOutline, KeepsModulesApartThatTouchAtACorner) {
  EXPECT_THAT(TraceBlackOutlines(PatternOf({"#.", ".#"})), ElementsAre(SizeIs(4), SizeIs(4)));
  EXPECT_THAT(TraceBlackOutlines(PatternOf({".#", "#."})), ElementsAre(SizeIs(4), SizeIs(4)));
}

TEST(PageSize, IsReadByNameAndByMillimetres) {
  EXPECT_EQ(ParsePageSize("A4"), (PageSize{210, 297}));
  EXPECT_EQ(ParsePageSize("A3-landscape"), (PageSize{420, 297}));
  EXPECT_EQ(ParsePageSize("300x400.5"), (PageSize{300, 400.5}));
  for (const char* bad : {"", "A9", "A4-", "300", "300x", "x300", "300x400x5", "10x300", "nanxnan",
                          "300x1e9", "-300x400"}) {
    EXPECT_FALSE(ParsePageSize(bad)) << bad;
  }
}

TEST(PageSize, ToFitIsTheSmallestWithAName) {
  EXPECT_EQ(PageName(FindPageFor({200, 290})), "A4");
  EXPECT_EQ(PageName(FindPageFor({290, 200})), "A4-landscape");
  EXPECT_EQ(PageName(FindPageFor({320, 357})), "A2");
  EXPECT_EQ(PageName(FindPageFor({1500.2, 20})), "1501x20");
}

TEST(MarkerNumbers, AreReadAloneAndAsRanges) {
  EXPECT_THAT(*app::ParseMarkerNumbers({"17", "3-5", "0", "4095-4095"}),
              ElementsAre(17, 3, 4, 5, 0, 4095));
  for (const char* bad : {"4096", "-1", "5-4", "1-4096", "a", "", "1.5", "3-", "0x10", "1-2-3",
                          "99999999999999999999"}) {
    const auto numbers = app::ParseMarkerNumbers({bad});
    ASSERT_FALSE(numbers) << bad;
    EXPECT_THAT(numbers.error().Message(), HasSubstr("0 to 4095"));
  }
}

TEST(MarkerSheet, PutsTheBlackSquareInItsSizeOnThePage) {
  const auto sheet = MarkerSheet(17, 123.4, {210, 297});
  ASSERT_TRUE(sheet);
  const CornersOnPage corners = FindCorners(sheet->prints.at(0));
  EXPECT_NEAR(corners[1].x - corners[0].x, 123.4, 1e-9);
  EXPECT_NEAR(corners[3].y - corners[0].y, 123.4, 1e-9);
  EXPECT_NEAR(0.5 * (corners[0].x + corners[1].x), 105.0, 1.0);
}

TEST(MarkerSheet, KeepsAllInkOutOfTheWhiteMarginAndOnThePage) {
  for (const double size_mm : {4.0, 40.0, 140.0, 158.0}) {
    const auto sheet = MarkerSheet(17, size_mm, {210, 297});
    ASSERT_TRUE(sheet) << size_mm;
    const Vec2 start = sheet->prints.at(0).top_left_mm;
    const Vec2 end = start + Vec2{1.2, 1.2} * size_mm;
    for (const SheetRectangle& ink : sheet->rectangles) {
      const Vec2 from = ink.top_left_mm, to = ink.top_left_mm + ink.size_mm;
      EXPECT_TRUE(to.x < start.x || from.x > end.x || to.y < start.y || from.y > end.y);
      EXPECT_GE(from.x, 5.0);
      EXPECT_GE(from.y, 5.0);
      EXPECT_LE(to.x, 205.0);
      EXPECT_LE(to.y, 292.0);
    }
    // The first text is the label above the margin, where the crop marks are.
    const SheetText& label = sheet->texts.at(0);
    EXPECT_LT(label.baseline_mm.y, start.y);
    for (const SheetText& text : sheet->texts) {
      if (&text == &label) continue;
      EXPECT_GT(text.baseline_mm.y, end.y + 3.0);
    }
  }
}

TEST(MarkerSheet, KeepsNumberSizeAndTopBetweenTheCropMarks) {
  for (const double size_mm : {4.0, 40.0, 140.0}) {
    const auto sheet = MarkerSheet(17, size_mm, {210, 297});
    ASSERT_TRUE(sheet) << size_mm;
    double left = 1e9, right = 0.0, top = 1e9, bottom = 0.0;
    // Crop marks are the first eight lines; they end 1 mm outside of what they bound.
    for (int i = 0; i < 8; ++i) {
      const SheetRectangle& mark = sheet->rectangles.at(i);
      const Vec2 middle = mark.top_left_mm + mark.size_mm * 0.5;
      if (mark.size_mm.x > mark.size_mm.y) {
        top = std::min(top, middle.y);
        bottom = std::max(bottom, middle.y);
      } else {
        left = std::min(left, middle.x);
        right = std::max(right, middle.x);
      }
    }
    const SheetText& label = sheet->texts.at(0);
    EXPECT_THAT(label.text, AllOf(HasSubstr("top"), HasSubstr("17"), HasSubstr("mm")));
    EXPECT_GE(label.baseline_mm.x, left);
    EXPECT_LE(label.baseline_mm.x + 0.55 * label.size_mm * label.text.size(), right + 0.01);
    EXPECT_GE(label.baseline_mm.y - label.size_mm, top);
    EXPECT_LE(label.baseline_mm.y, sheet->prints.at(0).top_left_mm.y);
    EXPECT_NEAR(bottom - sheet->prints.at(0).top_left_mm.y, 1.2 * size_mm, 1e-9);
  }
}

TEST(MarkerSheet, ReportsWhichPageWouldFit) {
  const auto sheet = MarkerSheet(17, 200.0, {210, 297});
  ASSERT_FALSE(sheet);
  EXPECT_THAT(sheet.error().Message(), HasSubstr("--page A3"));
  ASSERT_TRUE(MarkerSheet(17, 200.0, *ParsePageSize("A3")));
}

TEST(BoardSheet, ShowsWhatItsDescriptionSays) {
  const Board board{.columns = 3, .rows = 2, .first = 40, .size_mm = 30.0, .gap_mm = 7.5};
  const auto sheet = BoardSheet(board, {210, 297});
  ASSERT_TRUE(sheet);
  const auto description = nlohmann::json::parse(DescribeBoard(board));
  EXPECT_EQ(description["marker_size_m"], 0.03);
  ASSERT_EQ(description["markers"].size(), 6U);
  ASSERT_EQ(sheet->prints.size(), 6U);
  // The board's centre on the page.
  const Vec2 first = FindCorners(sheet->prints[0])[0], last = FindCorners(sheet->prints[5])[2];
  const Vec2 centre = (first + last) * 0.5;
  for (int i = 0; i < 6; ++i) {
    const auto& marker = description["markers"][i];
    EXPECT_EQ(marker["id"], 40 + i);
    EXPECT_EQ(sheet->prints[i].pattern.white, tracker::SgMarkerPattern(40 + i).white);
    const CornersOnPage corners = FindCorners(sheet->prints[i]);
    for (int c = 0; c < 4; ++c) {
      EXPECT_NEAR(marker["corners_m"][c][0].get<double>() * 1e3, corners[c].x - centre.x, 1e-9);
      EXPECT_NEAR(marker["corners_m"][c][1].get<double>() * 1e3, centre.y - corners[c].y, 1e-9);
      EXPECT_EQ(marker["corners_m"][c][2], 0.0);
    }
  }
}

/// Light of a rendered page around a point, 1 mm per side.
double LightAt(const Image<std::uint8_t>& page, Vec2 at_mm) {
  double light = 0.0;
  for (int i = 0; i < kSheetPixelsPerMm * kSheetPixelsPerMm; ++i) {
    const int x = static_cast<int>((at_mm.x - 0.5) * kSheetPixelsPerMm) + i % kSheetPixelsPerMm;
    const int y = static_cast<int>((at_mm.y - 0.5) * kSheetPixelsPerMm) + i / kSheetPixelsPerMm;
    light += LinearFromSrgb8()[page(x, y)];
  }
  return light / (kSheetPixelsPerMm * kSheetPixelsPerMm);
}

TEST(SquareBoardSheet, HasItsCornersWhereItsDescriptionSays) {
  for (const bool charuco : {false, true}) {
    SquareBoard board;
    board.board = {charuco ? tracker::BoardKind::kCharuco : tracker::BoardKind::kChessboard,
                   6,
                   5,
                   0.0,
                   0.0,
                   0,
                   charuco ? "4x4_50" : ""};
    board.board.square_m = 1.0;
    const auto largest = MaxSquare_mm(board.board, {210, 297});
    ASSERT_TRUE(largest);
    EXPECT_EQ(*largest, charuco ? 27.0 : 23.0);  // (210 - 2 * 10) / (6 or 7, and 1 of white)
    board.board.square_m = 0.018;
    board.marker_mm = 12.0;
    const auto sheet = SquareBoardSheet(board, {210, 297});
    ASSERT_TRUE(sheet) << sheet.error().Message();
    const Image<std::uint8_t> page = RasterizeSheet(*sheet);
    const auto description = nlohmann::json::parse(DescribeBoard(board));
    EXPECT_EQ(description["square_m"], 0.018);
    EXPECT_EQ(description["corners_m"].size(), charuco ? 20U : 30U);
    const double columns = charuco ? 6 : 7, rows = charuco ? 5 : 6;
    const Vec2 middle = sheet->prints[0].top_left_mm + Vec2{columns, rows} * 9.0;
    for (const auto& corner : description["corners_m"]) {
      const Vec2 at{middle.x + corner[0].get<double>() * 1e3,
                    middle.y - corner[1].get<double>() * 1e3};
      // Black and white meet diagonally: half of the surroundings is black.
      const double one = LightAt(page, at + Vec2{1, 1}), other = LightAt(page, at + Vec2{-1, 1});
      EXPECT_NEAR(one + other, 1.0, 1e-6);
      EXPECT_EQ(LightAt(page, at + Vec2{-1, -1}), one);
      EXPECT_EQ(LightAt(page, at + Vec2{1, -1}), other);
      EXPECT_NEAR(LightAt(page, at), 0.5, 1e-6);
    }
  }
  const auto small =
      MaxSquare_mm({tracker::BoardKind::kChessboard, 60, 60, 1.0, 0.0, 0, ""}, {210, 297});
  ASSERT_FALSE(small);
  EXPECT_THAT(small.error().Message(), HasSubstr("--page"));
}

TEST(PredictedImage, HasWholePixelsForModulesAtMultiplesOfTheirNumber) {
  const tracker::MarkerPattern print = tracker::SgMarkerPattern(1234);
  const Image<std::uint8_t> picture = RasterizeMarker(print, 3 * sg::kModules);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      ASSERT_EQ(picture(x, y), print.white[y / 3 * sg::kModules + x / 3] != 0 ? 255 : 0);
    }
  }
}

TEST(PredictedImage, HoldsTheEdgeFractionExactlyAtAnyNumberOfPixels) {
  const tracker::MarkerPattern print = tracker::SgMarkerPattern(1234);
  for (const int pixels : {48, 49, 100, 333, 500, 1001}) {
    const Image<std::uint8_t> picture = RasterizeMarker(print, pixels);
    // Along the rim's first row, black over the whole width, missing light is the black square's
    // edge.
    const int y = pixels * (sg::kQuiet + 2) / sg::kModules;
    double black_px = 0.0, moment = 0.0;
    for (int x = 0; x < pixels; ++x) {
      const double black = 1.0 - LinearFromSrgb8()[picture(x, y)];
      black_px += black;
      moment += black * (x + 0.5);
    }
    // 8-bit rounding is 1/255 in sRGB, up to 0.009 in linear light, on each of two edges.
    EXPECT_NEAR(black_px, pixels * 40.0 / 48.0, 0.01) << pixels;
    EXPECT_NEAR(moment / black_px, 0.5 * pixels, 0.01) << pixels;
  }
}

TEST(PredictedImage, HasTheMeanLightOfItsModules) {
  const tracker::MarkerPattern print = tracker::SgMarkerPattern(77);
  double white = 0.0;
  for (const std::uint8_t module : print.white) white += module;
  const Image<std::uint8_t> picture = RasterizeMarker(print, 1001);
  double light = 0.0;
  for (std::size_t i = 0; i < picture.size(); ++i) light += LinearFromSrgb8()[picture.data()[i]];
  EXPECT_NEAR(light / static_cast<double>(picture.size()),
              white / static_cast<double>(print.white.size()), 2e-4);
}

TEST(GrayPng, HoldsThePixelsAndTheResolution) {
  Image<std::uint8_t> picture(3, 2);
  for (int i = 0; i < 6; ++i) picture.data()[i] = static_cast<std::uint8_t>(40 * i);
  const auto png = EncodeGrayPng(picture.view(), 11811.4);
  ASSERT_TRUE(png);
  // pHYs (PNG specification, 11.3.5.3): pixels per unit across and down, unit 1 = metre.
  EXPECT_THAT(*png, HasSubstr(std::string("pHYs\0\0\x2e\x23\0\0\x2e\x23\x01", 13)));
  const cv::Mat bytes(1, static_cast<int>(png->size()), CV_8UC1, const_cast<char*>(png->data()));
  const cv::Mat read = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.size(), cv::Size(3, 2));
  ASSERT_EQ(read.type(), CV_8UC1);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(read.data[i], 40 * i);
}

}  // namespace
}  // namespace pleinair::exports
