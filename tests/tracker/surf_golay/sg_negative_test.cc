// Tests images without S-G markers, and degenerate images.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "tests/tracker/surf_golay/sg_test_scenes.h"
#include "tracker/april_tag_detector.h"
#include "tracker/golay/golay_code.h"
#include "tracker/surf_golay/sg_layout.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {
namespace {

using testing::IsEmpty;

void ExpectNothing(Tracker* tracker, const GreyImage& image) {
  const auto found = Track(tracker, image);
  EXPECT_TRUE(found.empty()) << Summary(found);
}

/// A border without a legible number is reported as such.
void ExpectOneWithoutNumber(Tracker* tracker, const GreyImage& image) {
  const auto found = Track(tracker, image);
  ASSERT_EQ(found.size(), 1U) << Summary(found);
  EXPECT_FALSE(found[0].detection.id) << Summary(found);
}

GreyImage Filled(const CameraModel& camera, std::uint8_t code) {
  GreyImage image(camera.width, camera.height);
  std::fill_n(image.data(), image.size(), code);
  return image;
}

GreyImage Noise(const CameraModel& camera, unsigned seed, double deviation, int grain_px) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(128.0, deviation);
  GreyImage image(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      image(x, y) = x % grain_px != 0 ? image(x - 1, y)
                    : y % grain_px != 0
                        ? image(x, y - 1)
                        : static_cast<std::uint8_t>(std::clamp(noise(random), 0.0, 255.0));
    }
  }
  return image;
}

TEST(SgDetection, SeesNothingInBlankAndNoisyPictures) {
  const CameraModel camera = SgCamera(200, 150);
  for (const bool consecutive : {false, true}) {
    const auto tracker = MakeSgTracker(camera, {.consecutive_frames = consecutive});
    for (const std::uint8_t code : {0, 1, 128, 254, 255}) {
      SCOPED_TRACE(testing::Message() << "all of code " << static_cast<int>(code));
      ExpectNothing(tracker.get(), Filled(camera, code));
    }
    for (unsigned seed = 1; seed <= 12; ++seed) {
      SCOPED_TRACE(testing::Message() << "noise of seed " << seed);
      ExpectNothing(tracker.get(), Noise(camera, seed, 15.0 * seed, 1 + seed % 6));
    }
    EXPECT_THAT(tracker->Warnings(), IsEmpty());
    EXPECT_THAT(tracker->Lost(), IsEmpty());
  }
}

TEST(SgDetection, TakesPicturesOfEveryShape) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 200}, {200, 1}, {2, 2}, {3, 7}, {16, 16}, {17, 40}, {641, 33}}) {
    const CameraModel camera = SgCamera(width, height);
    for (const bool consecutive : {false, true}) {
      SCOPED_TRACE(testing::Message() << width << "x" << height);
      const auto tracker = MakeSgTracker(
          camera, {.strategy = width == 16 ? SgStrategy::kSurfGolay : SgStrategy::kHybrid,
                   .consecutive_frames = consecutive});
      ExpectNothing(tracker.get(), Filled(camera, 200));
      ExpectNothing(tracker.get(), Noise(camera, 1, 60.0, 1));
    }
  }
}

TEST(SgDetection, RefusesPicturesThatAreNotItsCameras) {
  const auto tracker = MakeSgTracker(SgCamera(64, 48));
  EXPECT_FALSE(tracker->Track(ImageView<const std::uint8_t>()).has_value());
  EXPECT_FALSE(tracker->Track(GreyImage(48, 64).view()).has_value());
  EXPECT_FALSE(tracker->Track(RgbImage(64, 48, 3).view()).has_value());
  ExpectNothing(tracker.get(), GreyImage(64, 48));
  for (const auto& [width, height] : {std::pair{0, 0}, {0, 5}, {5, 0}, {-1, 5}}) {
    EXPECT_FALSE(Tracker::Create(SgCamera(width, height), {.families = {"sg"}, .marker_size_m = 1})
                     .has_value());
  }
}

/// Random modules, optionally with the three finder patterns of a QR code. The quiet zone is the
/// marker's.
std::shared_ptr<const MarkerPattern> RandomGrid(unsigned seed, int side, bool eyes) {
  std::mt19937 random(seed);
  MarkerPattern grid;
  grid.modules = side + 8;
  grid.edge_modules = side;
  grid.white.assign(static_cast<std::size_t>(grid.modules) * grid.modules, 1);
  const auto eye = [&](int x, int y) {
    const int ring = std::max(std::abs(x - 3), std::abs(y - 3));
    return ring == 2 || ring > 3;
  };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      bool white = (random() & 1U) != 0;
      if (eyes && x < 8 && y < 8) white = eye(x, y);
      if (eyes && side - 1 - x < 8 && y < 8) white = eye(side - 1 - x, y);
      if (eyes && x < 8 && side - 1 - y < 8) white = eye(x, side - 1 - y);
      grid.white[(y + 4) * grid.modules + x + 4] = white ? 1 : 0;
    }
  }
  return std::make_shared<MarkerPattern>(grid);
}

std::shared_ptr<const MarkerPattern> Chequers(int side) {
  MarkerPattern grid;
  grid.modules = side + 2;
  grid.edge_modules = side;
  grid.white.assign(static_cast<std::size_t>(grid.modules) * grid.modules, 1);
  for (int y = 1; y <= side; ++y) {
    for (int x = 1; x <= side; ++x) grid.white[y * grid.modules + x] = (x + y) & 1;
  }
  return std::make_shared<MarkerPattern>(grid);
}

/// A marker's rim with a randomly colored border, and cells that are half wrong.
std::shared_ptr<const MarkerPattern> ForgedBorder(unsigned seed) {
  std::mt19937 random(seed);
  MarkerPattern print = SgMarkerPatternOfWord(CodewordOfNumber(17) ^ 0x0F0F0F);
  for (int y = 4; y < 36; y += 2) {
    for (int x = 4; x < 36; x += 2) {
      if (x >= 8 && x < 32 && y >= 8 && y < 32) continue;
      const std::uint8_t white = random() & 1U;
      for (const int at : {0, 1, print.modules, print.modules + 1}) {
        print.white[(y + 4) * print.modules + x + 4 + at] = white;
      }
    }
  }
  return std::make_shared<MarkerPattern>(print);
}

TEST(SgDetection, SeesNoMarkerInOtherPrints) {
  const CameraModel camera = SgCamera();
  std::vector<std::pair<std::string, std::shared_ptr<const MarkerPattern>>> prints;
  for (const int side : {3, 5, 8, 11, 40}) {
    prints.emplace_back("chequers " + std::to_string(side), Chequers(side));
  }
  for (unsigned seed = 1; seed <= 4; ++seed) {
    prints.emplace_back("QR code " + std::to_string(seed), RandomGrid(seed, 21 + 4 * seed, true));
    prints.emplace_back("grid " + std::to_string(seed), RandomGrid(seed, 10 * seed, false));
    prints.emplace_back("forged border " + std::to_string(seed), ForgedBorder(seed));
    prints.emplace_back("AprilTag " + std::to_string(seed), AprilTagPattern("tag36h11", seed));
  }
  const auto tracker = MakeSgTracker(camera);
  // With one number in use there is no alternative that could be more likely.
  const auto one = MakeSgTracker(camera, {.numbers_in_use = {17}});
  std::uint32_t seed = 1;
  for (const auto& [name, print] : prints) {
    SCOPED_TRACE(name);
    RenderedMarker marker = SgMarkerAt(camera, 0, {161, 118}, 120, 25, 30.0 * seed, 20.0 * seed);
    marker.pattern = print;
    const GreyImage image =
        RenderMarkers(camera, {marker}, {.blur_px = 0.5, .noise_codes = 1.0, .seed = seed++});
    ExpectNothing(tracker.get(), image);
    ExpectNothing(one.get(), image);
    EXPECT_THAT(tracker->Warnings(), IsEmpty());
  }
}

/// Number of cells in which `word` differs from the nearest number.
int CellsFromNearestNumber(GolayWord word) {
  int nearest = kGolayBits;
  for (int number = 0; number < kGolayNumbers; ++number) {
    nearest = std::min(nearest, std::popcount(word ^ CodewordOfNumber(number)));
  }
  return nearest;
}

TEST(SgDetection, GivesNoNumberToCellsThatAreNoNumbers) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  const auto one = MakeSgTracker(camera, {.numbers_in_use = {17}});
  // All black and all white are four cells from the nearest number (golay_code.h). So are the words
  // four cells from 17; the last two are half wrong.
  const GolayWord near = CodewordOfNumber(17);
  std::uint32_t seed = 1;
  for (const GolayWord word : {0U, 0xFFFFFFU, near ^ 0xFU, near ^ 0x208041U, near ^ 0x700001U,
                               near ^ 0xFFF000U, near ^ 0xA5A5A5U}) {
    SCOPED_TRACE(testing::Message() << "word " << std::hex << word);
    for (const double side_px : {130.0, 44.0}) {
      RenderedMarker marker = SgMarkerAt(camera, 0, {161, 118}, side_px, 25, 30.0 * seed, 10);
      marker.pattern = std::make_shared<MarkerPattern>(SgMarkerPatternOfWord(word));
      const GreyImage image =
          RenderMarkers(camera, {marker}, {.blur_px = 0.5, .noise_codes = 1.0, .seed = seed++});
      if (CellsFromNearestNumber(word) > 3) ExpectOneWithoutNumber(tracker.get(), image);
      for (const MarkerObservation& seen : Track(one.get(), image)) {
        EXPECT_TRUE(!seen.detection.id || std::popcount(word ^ near) <= 4);
      }
    }
  }
}

TEST(SgDetection, GivesMirroredPrintsNoNumberFromAnywhere) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  const auto keypoints = MakeSgTracker(camera, {.strategy = SgStrategy::kSurfGolay});
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RenderedMarker marker = SgMarkerAt(camera, 400 * seed, {161, 118}, 40.0 + 12 * seed, 8.0 * seed,
                                       50.0 * seed, 45.0 * seed);
    MarkerPattern mirrored = *marker.pattern;
    for (int row = 0; row < mirrored.modules; ++row) {
      std::reverse(mirrored.white.begin() + row * mirrored.modules,
                   mirrored.white.begin() + (row + 1) * mirrored.modules);
    }
    marker.pattern = std::make_shared<MarkerPattern>(mirrored);
    const GreyImage image =
        RenderMarkers(camera, {marker}, {.blur_px = 0.5, .noise_codes = 1.0, .seed = seed});
    ExpectNothing(tracker.get(), image);
    ExpectNothing(keypoints.get(), image);
  }
}

// Each pair differs in eight adjacent cells that have one color on the first marker. The first
// marker thus equals the second one under a cover of ink or paper.
TEST(SgNegative, TakesAPrintNotInUseForNoCoveredOneThatIsAndStillReadsThatOneCovered) {
  struct {
    int printed, in_use;
  } constexpr kPairs[] = {{2986, 491}, {826, 861}, {2944, 4049}, {2758, 3542}};
  const CameraModel camera = SgCamera();
  std::uint32_t seed = 1;
  for (const auto& [printed, in_use] : kPairs) {
    SCOPED_TRACE(testing::Message() << printed << " printed, " << in_use << " in use");
    const auto tracker =
        MakeSgTracker(camera, {.strategy = SgStrategy::kFast, .numbers_in_use = {in_use}});
    const RenderingOptions options{.blur_px = 0.5, .noise_codes = 1.0, .seed = seed};
    for (const double side_px : {30.0, 60.0, 100.0}) {
      const RenderedMarker other =
          SgMarkerAt(camera, printed, {161, 118}, side_px, 0, 0, 25.0 * seed);
      const auto none = Track(tracker.get(), RenderMarkers(camera, {other}, options));
      EXPECT_TRUE(none.empty()) << Summary(none);
    }

    // A hand on all but one or two of the differing cells: the visible ones must decide.
    for (const int left_open : {1, 2}) {
      GolayWord hidden = CodewordOfNumber(printed) ^ CodewordOfNumber(in_use);
      for (int i = 0; i < left_open; ++i) hidden &= hidden - 1;
      RenderedMarker held = SgMarkerAt(camera, printed, {161, 118}, 60, 0, 0, 25.0 * seed);
      held.cover = [hidden](Vec2 at) {
        const Vec2 modules = ModulesOf(at);
        const int column = sg::CellIndex(static_cast<int>(std::floor(modules.x)));
        const int row = sg::CellIndex(static_cast<int>(std::floor(modules.y)));
        const int cell = column < 0 || row < 0 ? -1 : sg::CodeCell(column, row);
        return cell >= 0 && (hidden >> cell & 1U) != 0 ? 0.3 : -1.0;
      };
      for (const auto& seen : Track(tracker.get(), RenderMarkers(camera, {held}, options))) {
        EXPECT_FALSE(seen.detection.id) << left_open << " left open: " << Summary({seen});
      }
    }

    RenderedMarker barred =
        SgMarkerAt(camera, in_use, {161, 118}, 90, 15, 40.0 * seed, 25.0 * seed);
    barred.cover = [](Vec2 at) {
      const Vec2 modules = ModulesOf(at);
      return std::fabs(modules.x - 20) < 10 && std::fabs(modules.y - 16) < 4 ? 0.06 : -1.0;
    };
    const auto found = Track(tracker.get(), RenderMarkers(camera, {barred}, options));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].detection.id, in_use);
    ++seed;
  }
}

// A cover on the cells may resemble the border of another marker, squeezed or small. At least half
// of a marker must be visible to be detected across one with a visible border.
TEST(SgNegative, SeesNoMostlyCoveredPrintAcrossAnotherWhoseBorderLiesOpen) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  RenderedMarker open = SgMarkerAt(camera, 17, {161, 118}, 190, 10, 30, 10);
  const MarkerPattern small = SgMarkerPattern(2741);
  for (const int hidden_columns : {8, 13}) {
    SCOPED_TRACE(testing::Message() << hidden_columns << " columns hidden");
    open.cover = [&](Vec2 at) {
      const Vec2 modules = (ModulesOf(at) - Vec2{10.5, 10.5}) * (small.modules / 19.0);
      const int x = static_cast<int>(std::floor(modules.x));
      const int y = static_cast<int>(std::floor(modules.y));
      if (x < 0 || y < 0 || x >= small.modules || y >= small.modules) return -1.0;
      if (x < hidden_columns || x > 35 || y > 35) return 0.3;
      return small.white[y * small.modules + x] != 0 ? 0.8 : 0.04;
    };
    const auto found =
        Track(tracker.get(), RenderMarkers(camera, {open}, {.blur_px = 0.5, .noise_codes = 1.0}));
    ASSERT_EQ(found.size(), 1U) << Summary(found);
    EXPECT_EQ(found[0].detection.id.has_value(), hidden_columns == 8) << Summary(found);
  }
}

// A hand on the eight black cells in which a print differs from another, on as much again of the
// border and on halves of other cells. It parts from the ink better than from the paper: taken for
// paper in the shade, it would make up the other number, but for what the border shows of the
// light.
TEST(SgNegative, TakesNoHandForPaperInTheShade) {
  struct {
    int printed, made_up;
    double light;
    int border_columns, half_cells;
  } constexpr kHands[] = {{861, 826, 0.2, 24, 5},
                          {861, 826, 0.3, 24, 0},
                          {4049, 2944, 0.3, 30, 5},
                          {3542, 2758, 0.3, 24, 5}};
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  for (const auto& hand : kHands) {
    SCOPED_TRACE(testing::Message() << hand.printed << " printed, hand of light " << hand.light);
    const GolayWord hidden = CodewordOfNumber(hand.printed) ^ CodewordOfNumber(hand.made_up);
    ASSERT_EQ(CodewordOfNumber(hand.printed) & hidden, 0U);
    GolayWord half_hidden = 0;
    for (int k = 0; std::popcount(half_hidden) < hand.half_cells; ++k) {
      half_hidden |= ~hidden & 1U << k;
    }
    RenderedMarker held = SgMarkerAt(camera, hand.printed, {161, 118}, 110, 20, 30, 25);
    held.cover = [=](Vec2 at) {
      const Vec2 modules = ModulesOf(at);
      if (modules.x < 9.5 && modules.y < hand.border_columns) return hand.light;
      if (modules.y > 30.5 && modules.x < hand.border_columns) return hand.light;
      const int column = sg::CellIndex(static_cast<int>(std::floor(modules.x)));
      const int row = sg::CellIndex(static_cast<int>(std::floor(modules.y)));
      const int cell = column < 0 || row < 0 ? -1 : sg::CodeCell(column, row);
      if (cell < 0) return -1.0;
      const bool left_half = modules.x - sg::kContent - sg::kCell * column < 0.5 * sg::kCell;
      const GolayWord covered = hidden | (left_half ? half_hidden : 0U);
      return (covered >> cell & 1U) != 0 ? hand.light : -1.0;
    };
    const auto none =
        Track(tracker.get(), RenderMarkers(camera, {held}, {.blur_px = 0.5, .noise_codes = 1.0}));
    EXPECT_TRUE(none.empty()) << Summary(none);
  }
}

}  // namespace
}  // namespace pleinair::tracker
