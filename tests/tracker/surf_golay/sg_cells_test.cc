// Tests the observed cell values of a marker and their likelihoods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "tests/tracker/surf_golay/sg_test_scenes.h"
#include "tracker/golay/golay_code.h"
#include "tracker/pose/homography.h"
#include "tracker/surf_golay/cells/cell_light.h"
#include "tracker/surf_golay/cells/cell_reader.h"
#include "tracker/surf_golay/cells/cell_split.h"
#include "tracker/surf_golay/cells/fast_cell_sampling.h"
#include "tracker/surf_golay/marker_square.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {
namespace {

/// A cell's centre on the marker: half edges from the marker's centre, x right, y up.
Vec2 CellMiddle(int cell) {
  const auto at = [](int index) { return (index - 2) * sg::kCell / (0.5 * sg::kEdge); };
  return {at(sg::CodeCellColumn(cell)), -at(sg::CodeCellRow(cell))};
}

/// The cells of a marker whose border was fitted from its true position.
class ReadCells {
 public:
  ReadCells(const CameraModel& camera, const RenderedMarker& marker,
            const RenderingOptions& options, bool with_glare = false)
      : lens_(camera), blank_(SgMarkerPatternOfWord(0)) {
    const GreyImage image = RenderMarkers(camera, {marker}, options);
    BlockFitState state{ModulesFromSquareCorners(TrueCorners(camera, marker)), 0.5};
    TakeLinearWindow(lens_, image.view(), {0, 0, 0, camera.width, camera.height}, &seen_);
    BlockFitOptions fitting;
    fitting.fit_blur = true;
    MarkerLight light;
    ok_ = fit_.Run(blank_, MarkerPart::kBorder, seen_, 8, fitting, &state) &&
          MarkerLightEstimator().Measure(blank_, fit_, seen_, false, &light);
    if (ok_) CellReader().ReadCells(blank_, fit_, seen_, state, light, with_glare, &cells_);
  }

  bool ok() const { return ok_; }
  const CellReading& operator*() const { return cells_; }
  const CellReading* operator->() const { return &cells_; }

 private:
  LensGrid lens_;
  MarkerPattern blank_;
  ObservedPatch seen_;
  BlockFit fit_;
  CellReading cells_;
  bool ok_ = false;
};

constexpr int kNumber = 2741;

RenderedMarker Marker(const CameraModel& camera, double side_px) {
  return SgMarkerAt(camera, kNumber, {80, 75}, side_px, 20, 50, 8);
}

/// Cells whose likelihood clearly favours the wrong color.
int PlainlyWrong(const CellReading& cells) {
  int wrong = 0;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    const float likelihood = cells.likelihoods[k];
    wrong += std::fabs(likelihood) > 1.5F && (likelihood > 0.0F) != IsWhite(kNumber, k);
  }
  return wrong;
}

int NumberOf(const CellReading& cells) {
  return SoftGolayDecoder().Decode(cells.likelihoods).number;
}

TEST(SgCells, AreBlackOrWhiteAsPrintedHoweverSmall) {
  const CameraModel camera = SgCamera(160, 150, 300);
  for (const double side_px : {100.0, 60.0, 40.0, 24.0}) {
    SCOPED_TRACE(testing::Message() << "edge " << side_px << " px");
    const ReadCells cells(camera, Marker(camera, side_px), {.blur_px = 0.5, .noise_codes = 1.0});
    ASSERT_TRUE(cells.ok());
    for (int k = 0; k < sg::kCodeCells; ++k) {
      SCOPED_TRACE(testing::Message() << "cell " << k);
      EXPECT_TRUE(cells->observed[k]);
      EXPECT_NEAR(cells->white[k], IsWhite(kNumber, k) ? 1.0 : 0.0, side_px > 30 ? 0.1 : 0.25);
      EXPECT_GT(IsWhite(kNumber, k) ? cells->likelihoods[k] : -cells->likelihoods[k], 2.0F);
    }
    EXPECT_FALSE(cells->glaring);
  }
}

TEST(SgCells, SayNothingWhereTheyAreCovered) {
  const CameraModel camera = SgCamera(160, 150, 300);
  for (const double light : {0.12, 0.3, 0.5}) {
    SCOPED_TRACE(testing::Message() << "cover of light " << light);
    RenderedMarker marker = Marker(camera, 90);
    // Only the two right columns of cells.
    marker.cover = [=](Vec2 at) {
      return at.x > 0.1 && at.x < 0.5 && std::fabs(at.y) < 0.5 ? light : -1.0;
    };
    const ReadCells cells(camera, marker, {.blur_px = 0.5, .noise_codes = 1.0});
    ASSERT_TRUE(cells.ok());
    for (int k = 0; k < sg::kCodeCells; ++k) {
      SCOPED_TRACE(testing::Message() << "cell " << k);
      if (sg::CodeCellColumn(k) >= 3) {
        EXPECT_LT(std::fabs(cells->likelihoods[k]), 1.0F);
      } else {
        EXPECT_GT(IsWhite(kNumber, k) ? cells->likelihoods[k] : -cells->likelihoods[k], 1.5F);
      }
    }
    EXPECT_EQ(NumberOf(*cells), kNumber);
  }
}

TEST(SgCells, AreNotSeenBeyondThePicture) {
  const CameraModel camera = SgCamera(160, 150, 300);
  // The right of the marker is outside the image.
  const RenderedMarker marker = SgMarkerAt(camera, kNumber, {148, 75}, 110);
  const ReadCells cells(camera, marker, {.blur_px = 0.5, .noise_codes = 1.0});
  ASSERT_TRUE(cells.ok());
  for (int k = 0; k < sg::kCodeCells; ++k) {
    SCOPED_TRACE(testing::Message() << "cell " << k);
    const double middle_px = 148 + 55 * CellMiddle(k).x;
    if (middle_px > 170) {
      EXPECT_FALSE(cells->observed[k]);
      EXPECT_EQ(cells->likelihoods[k], 0.0F);
    } else if (middle_px < 145) {
      EXPECT_TRUE(cells->observed[k]);
    }
  }
  EXPECT_EQ(PlainlyWrong(*cells), 0);
}

TEST(SgCells, ShowThroughGlareThatIsSmooth) {
  const CameraModel camera = SgCamera(160, 150, 300);
  RenderingOptions options{.blur_px = 0.5, .noise_codes = 1.0};
  options.glare = [](Vec2 pixel) {
    const double away = Norm(pixel - Vec2{95, 70}) / 22.0;
    return 0.35 * std::exp(-0.5 * away * away);
  };
  // White that the glare does not push beyond the camera's range.
  RenderedMarker marker = Marker(camera, 100);
  marker.white = 0.45;
  marker.black = 0.03;
  const ReadCells plain(camera, marker, options), glared(camera, marker, options, true);
  ASSERT_TRUE(plain.ok() && glared.ok());
  EXPECT_TRUE(plain->glaring);
  EXPECT_EQ(PlainlyWrong(*glared), 0);
  EXPECT_EQ(NumberOf(*glared), kNumber);
  const auto agreement = [](const CellReading& cells) {
    float sum = 0.0F;
    for (int k = 0; k < sg::kCodeCells; ++k) {
      sum += IsWhite(kNumber, k) ? cells.likelihoods[k] : -cells.likelihoods[k];
    }
    return sum;
  };
  EXPECT_GT(agreement(*glared), agreement(*plain));
}

// Glare that saturates most of the content: cells at its fringe must be distinguished from covers.
TEST(SgCells, ShowAroundTheCoreOfAHighlight) {
  const CameraModel camera = SgCamera(160, 150, 300);
  RenderingOptions options{.blur_px = 0.5, .noise_codes = 1.5};
  options.glare = [](Vec2 pixel) {
    const double away = Norm(pixel - Vec2{60, 60}) / 24.0;
    return 1.6 * std::exp(-std::numbers::ln2 * std::pow(away, 4.0));
  };
  const ReadCells cells(camera, Marker(camera, 110), options, true);
  ASSERT_TRUE(cells.ok());
  EXPECT_EQ(PlainlyWrong(*cells), 0);
  const SoftGolayDecoding decoding = SoftGolayDecoder().Decode(cells->likelihoods);
  EXPECT_GE(decoding.erasures, 3);
  EXPECT_EQ(decoding.number, kNumber);
  EXPECT_GT(decoding.margin, 8.0F);
}

// The known border beside the content determines the light on cells with almost no remaining
// contrast. A cell brighter than white is white under more glare.
TEST(SgCells, ShowAroundHighlightsByWhatIsKnownBesideThem) {
  // Minimum margins with the remaining contrast. Without the border beside the content the first
  // two are 8 and 10. Counting cells brighter than white, the others are 49 and 23.
  struct {
    Vec2 middle;
    double radius_px;
    float min_margin;
  } constexpr kSpots[] = {
      {{90, 65}, 24, 15.0F}, {{70, 85}, 24, 15.0F}, {{50, 65}, 16, 60.0F}, {{70, 65}, 16, 35.0F}};
  const CameraModel camera = SgCamera(160, 150, 300);
  for (const auto& spot : kSpots) {
    SCOPED_TRACE(testing::Message() << "spot at " << spot.middle.x << ", " << spot.middle.y);
    RenderingOptions options{.blur_px = 0.7, .noise_codes = 2.0};
    options.glare = [&](Vec2 pixel) {
      const double away = Norm(pixel - spot.middle) / spot.radius_px;
      return 1.6 * std::exp(-std::numbers::ln2 * std::pow(away, 4.0));
    };
    const ReadCells cells(camera, Marker(camera, 110), options, true);
    ASSERT_TRUE(cells.ok());
    const SoftGolayDecoding decoding = SoftGolayDecoder().Decode(cells->likelihoods);
    EXPECT_EQ(decoding.number, kNumber);
    EXPECT_GT(decoding.margin, spot.min_margin);
  }
}

// Paper near the maximum of the image range cannot look brighter than white under glare.
TEST(SgCells, GlareWhereLightDrownsThem) {
  const CameraModel camera = SgCamera(160, 150, 300);
  RenderedMarker marker = Marker(camera, 110);
  marker.white = 0.9;
  RenderingOptions options{.blur_px = 0.5, .noise_codes = 1.0};
  EXPECT_FALSE(ReadCells(camera, marker, options)->glaring);
  options.glare = [](Vec2 pixel) {
    return 1.6 * std::exp2(-std::pow(Norm(pixel - Vec2{80, 45}) / 19.0, 4.0));
  };
  EXPECT_TRUE(ReadCells(camera, marker, options)->glaring);
  const ReadCells glared(camera, marker, options, true);
  EXPECT_EQ(NumberOf(*glared), kNumber);
  EXPECT_EQ(PlainlyWrong(*glared), 0);
}

TEST(SgCells, AreReadWhereWhiteClips) {
  const CameraModel camera = SgCamera(160, 150, 300);
  for (const double exposure : {2.0, 4.0, 8.0}) {
    SCOPED_TRACE(testing::Message() << "exposed " << exposure << " times");
    RenderedMarker marker = Marker(camera, 90);
    marker.white *= exposure;
    marker.black *= exposure;
    const ReadCells cells(camera, marker, {.blur_px = 0.7, .noise_codes = 1.0});
    ASSERT_TRUE(cells.ok());
    EXPECT_EQ(PlainlyWrong(*cells), 0);
    EXPECT_EQ(NumberOf(*cells), kNumber);
    EXPECT_FALSE(cells->glaring);
  }
}

TEST(SgCells, AreReadAcrossAnEdgeOfShadow) {
  const CameraModel camera = SgCamera(160, 150, 300);
  RenderingOptions options{.blur_px = 0.5, .noise_codes = 1.0};
  options.light = [](Vec2 pixel) { return pixel.x + 0.4 * pixel.y < 112 ? 1.0 : 1.0 / 16; };
  const ReadCells cells(camera, Marker(camera, 100), options);
  ASSERT_TRUE(cells.ok());
  EXPECT_EQ(PlainlyWrong(*cells), 0);
  EXPECT_EQ(NumberOf(*cells), kNumber);
}

Mat3 TruePlace(const CameraModel& camera, const RenderedMarker& marker) {
  return ModulesFromSquareCorners(TrueCorners(camera, marker));
}

TEST(SgCells, AreToldAtAGlanceWhereAPrintLiesOpen) {
  const CameraModel camera = SgCamera(160, 150, 300);
  const LensGrid lens(camera);
  RenderingOptions options{.blur_px = 0.5, .noise_codes = 1.5};
  options.light = [](Vec2 pixel) { return 0.4 + 0.004 * pixel.x; };
  for (const int number : {0, kNumber, 4095}) {
    for (const double side_px : {100.0, 40.0, 24.0}) {
      SCOPED_TRACE(testing::Message() << "number " << number << ", edge " << side_px << " px");
      const RenderedMarker marker = SgMarkerAt(camera, number, {80, 75}, side_px, 35, 50, 8);
      const GreyImage image = RenderMarkers(camera, {marker}, options);
      const auto cells = SampleCellsFast(image.view(), lens, TruePlace(camera, marker));
      ASSERT_TRUE(cells.has_value());
      for (int k = 0; k < sg::kCodeCells; ++k) EXPECT_EQ((*cells)[k] > 0, IsWhite(number, k));
    }
  }
}

TEST(SgCells, AreNotToldAtAGlanceWhereAnythingIsDoubtful) {
  const CameraModel camera = SgCamera(160, 150, 300);
  const LensGrid lens(camera);
  const RenderedMarker marker = Marker(camera, 90);
  const auto told = [&](const RenderedMarker& of, const RenderingOptions& options) {
    const GreyImage image = RenderMarkers(camera, {of}, options);
    return SampleCellsFast(image.view(), lens, TruePlace(camera, of)).has_value();
  };
  ASSERT_TRUE(told(marker, {.blur_px = 0.5}));
  RenderedMarker covered = marker;
  covered.cover = [](Vec2 at) { return at.x > 0.1 && at.x < 0.5 && at.y < 0.0 ? 0.3 : -1.0; };
  EXPECT_FALSE(told(covered, {.blur_px = 0.5}));
  covered.cover = [](Vec2 at) { return at.x > 0.8 ? 0.3 : -1.0; };
  EXPECT_FALSE(told(covered, {.blur_px = 0.5}));
  RenderingOptions shaded{.blur_px = 0.5};
  shaded.light = [](Vec2 pixel) { return pixel.x < 85 ? 1.0 : 0.25; };
  EXPECT_FALSE(told(marker, shaded));
  EXPECT_FALSE(told(SgMarkerAt(camera, kNumber, {148, 75}, 110), {.blur_px = 0.5}));
}

// A hand is darker than any visible white cell beside it, and much lighter than ink.
TEST(SgCells, PartIntoBlackAndWhiteWithoutAHandForInk) {
  CellReading cells;
  cells.observed.fill(true);
  for (int k = 0; k < sg::kCodeCells; ++k) {
    const bool covered = k % 2 == 0;
    const float open = k % 4 == 1 ? 1.0F : 0.01F;
    cells.white[k] = covered ? 0.03F + 0.013F * static_cast<float>(k) : open;
  }
  const CellSplits splits = SplitCells(cells);
  ASSERT_GT(splits.count, 0);
  for (int k = 0; k < sg::kCodeCells; ++k) {
    const float likelihood = splits.likelihoods[0][k];
    if (k % 2 == 0) {
      if (k >= 16) {
        EXPECT_LT(std::fabs(likelihood), 1.0F) << k;
      }
    } else {
      EXPECT_GT(k % 4 == 1 ? likelihood : -likelihood, 3.0F) << k;
    }
  }
}

TEST(SgCells, LeaveNothingOfTheReadingBefore) {
  CellReading cells;
  cells.likelihoods.fill(7.0F);
  cells.observed.fill(true);
  cells.glaring = true;
  const CameraModel camera = SgCamera(64, 48);
  const LensGrid lens(camera);
  const MarkerPattern blank = SgMarkerPatternOfWord(0);
  ObservedPatch observed;
  BlockFit fit;
  // A marker outside the window has no cells there.
  const BlockFitState state{Mat3{{0.5, 0, 900, 0, 0.5, 900, 0, 0, 1}}, 0.5};
  const GreyImage image(camera.width, camera.height);
  TakeLinearWindow(lens, image.view(), {0, 0, 0, camera.width, camera.height}, &observed);
  fit.Evaluate(blank, MarkerPart::kBorder, observed, 4, state);
  CellReader().ReadCells(blank, fit, observed, state, {}, false, &cells);
  EXPECT_FALSE(cells.glaring);
  for (int k = 0; k < sg::kCodeCells; ++k) {
    EXPECT_FALSE(cells.observed[k]);
    EXPECT_EQ(cells.likelihoods[k], 0.0F);
  }
}

}  // namespace
}  // namespace pleinair::tracker
