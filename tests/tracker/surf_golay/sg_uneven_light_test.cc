// Tests S-G markers under hard shadows, gradients and glare.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/tracker/surf_golay/sg_test_scenes.h"

namespace pleinair::tracker {
namespace {

TEST(SgUnevenLight, FindsMarkersCrossedByAHardShadowOfOneToSixteen) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  std::uint32_t seed = 1;
  for (const double direction_deg : {0.0, 50.0, 110.0, 230.0}) {
    for (const double offset_px : {-20.0, 15.0}) {
      SCOPED_TRACE(testing::Message()
                   << "edge at " << direction_deg << "°, " << offset_px << " px");
      const RenderedMarker marker = SgMarkerAt(camera, 801, {161, 118}, 110, 20, 30.0 * seed, 10);
      const double c = std::cos(FromDegrees(direction_deg).value());
      const double s = std::sin(FromDegrees(direction_deg).value());
      RenderingOptions options{.blur_px = 0.5, .noise_codes = 1.0, .seed = seed++};
      options.light = [=](Vec2 pixel) {
        return (pixel.x - 161) * c + (pixel.y - 118) * s > offset_px ? 1.0 : 1.0 / 16.0;
      };
      const auto found = Track(tracker.get(), RenderMarkers(camera, {marker}, options));
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(found[0].detection.id, 801);
      EXPECT_LT(CornerRms(found[0], TrueCorners(camera, marker)), 0.3);
    }
  }
}

// Light that changes within blocks draws the corners, also where something lies on the print.
// In the shade noise is large, and what is predicted of it certain: light from beyond the edge in
// the same block must not be taken for as certain. (So it drew corners by up to 4 px.)
TEST(SgUnevenLight, MeasuresANoisyPrintInTheShadeOfAHardEdge) {
  const CameraModel camera = SgCamera(160, 150, 300);
  const auto tracker = MakeSgTracker(camera);
  const Vec2 centre{80, 75};
  std::uint32_t seed = 1;
  for (const double edge_px : {27.0, 38.0}) {
    for (const double angle : {0.6, 2.2, 3.8, 5.4}) {
      SCOPED_TRACE(testing::Message()
                   << "light " << edge_px << " px from the middle, at " << angle);
      const RenderedMarker marker =
          SgMarkerAt(camera, 493, centre, 110, 25, 100.0 * seed, 25.0 * seed);
      RenderingOptions options{.blur_px = 0.5, .noise_codes = 3.5, .seed = seed++};
      options.light = [=](Vec2 pixel) {
        const Vec2 from = pixel - centre;
        return from.x * std::cos(angle) + from.y * std::sin(angle) > edge_px ? 1.0 : 1.0 / 32;
      };
      const auto found = Track(tracker.get(), RenderMarkers(camera, {marker}, options));
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(found[0].detection.id, 493);
      EXPECT_LT(CornerRms(found[0], TrueCorners(camera, marker)), 0.25);
    }
  }
}

TEST(SgUnevenLight, MeasuresAPrintWithACoveredCornerUnderAGradient) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  constexpr int kPictures = 5;
  double squares = 0.0;
  for (std::uint32_t seed = 1; seed <= kPictures; ++seed) {
    SCOPED_TRACE(seed);
    RenderedMarker marker = SgMarkerAt(camera, 801, {161, 118}, 110, 20, 30.0 * seed, 15);
    constexpr double kSkin = 0.30;  // Linear light, between the marker's black and white.
    marker.cover = [](Vec2 at) {
      const Vec2 modules = ModulesOf(at);
      return modules.x + modules.y < 26 ? kSkin : -1.0;
    };
    RenderingOptions options{.blur_px = 0.5, .noise_codes = 1.0, .seed = seed};
    // A light gradient of 10:1 across the marker, without clipping.
    options.light = [](Vec2 pixel) { return 0.2 * std::exp2(0.03 * (pixel.x - 161)); };
    const auto found = Track(tracker.get(), RenderMarkers(camera, {marker}, options));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].detection.id, 801);
    EXPECT_LT(found[0].detection.visible_fraction, 0.93) << "measured as covered";
    const double rms = CornerRms(found[0], TrueCorners(camera, marker));
    squares += rms * rms;
  }
  EXPECT_LT(std::sqrt(squares / kPictures), 0.06);
}

TEST(SgUnevenLight, FindsMarkersWithGlareOnAFifth) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  std::uint32_t seed = 1;
  for (const Vec2 spot : {Vec2{127, 90}, Vec2{196, 146}, Vec2{161, 174}}) {
    SCOPED_TRACE(testing::Message() << "spot at " << spot.x << ", " << spot.y);
    const RenderedMarker marker = SgMarkerAt(camera, 3110, {161, 118}, 110, 20, 30.0 * seed, 10);
    RenderingOptions options{.blur_px = 0.5, .noise_codes = 1.0, .seed = seed++};
    // Saturated within 28 px of the spot: π 28² is a fifth of 110².
    options.glare = [=](Vec2 pixel) {
      const double away = Norm(pixel - spot) / 28.0;
      return 2.0 * std::exp(-0.7 * std::pow(away, 4));
    };
    const auto found = Track(tracker.get(), RenderMarkers(camera, {marker}, options));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].detection.id, 3110);
    EXPECT_LT(CornerRms(found[0], TrueCorners(camera, marker)), 0.5);
  }
}

// What the content alone tells may lie far off where most of it is drowned, and be cut into other
// blocks, which explain no more than those of the border's fit.
TEST(SgUnevenLight, MeasuresAnOpenBorderWithGlareOnTheCells) {
  const CameraModel camera = SgCamera(160, 150, 300);
  const auto tracker = MakeSgTracker(camera);
  const RenderedMarker marker = SgMarkerAt(camera, 1141, {80, 75}, 110, 20, 50, 8);
  for (const Vec2 middle : {Vec2{56, 75}, Vec2{56, 87}, Vec2{68, 87}}) {
    SCOPED_TRACE(testing::Message() << "spot at " << middle.x << ", " << middle.y);
    RenderingOptions options{.blur_px = 0.55, .noise_codes = 0.7};
    options.glare = [=](Vec2 pixel) {
      return 1.6 * std::exp2(-std::pow(Norm(pixel - middle) / 19.0, 4.0));
    };
    const auto found = Track(tracker.get(), RenderMarkers(camera, {marker}, options));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].detection.id, 1141);
    EXPECT_LT(CornerRms(found[0], TrueCorners(camera, marker)), 0.03);
  }
}

// Twelve certain cells select one of 4,096 numbers without further proof. On a border that is
// clearly a marker's they suffice where glare saturates the others.
TEST(SgUnevenLight, ReadsTheNumberWhereGlareLeavesHalfOfTheCells) {
  struct {
    Vec2 middle;
    double radius_px;
  } constexpr kSpots[] = {{{58, 86}, 36}, {{113, 75}, 39}, {{102, 97}, 39}};
  const CameraModel camera = SgCamera(160, 150, 300);
  const auto tracker = MakeSgTracker(camera);
  const RenderedMarker marker = SgMarkerAt(camera, 1465, {80, 75}, 110, 20, 50, 8);
  for (const auto& spot : kSpots) {
    SCOPED_TRACE(testing::Message() << "spot at " << spot.middle.x << ", " << spot.middle.y);
    RenderingOptions options{.blur_px = 0.55, .noise_codes = 0.7};
    options.glare = [&](Vec2 pixel) {
      return 1.6 * std::exp2(-std::pow(Norm(pixel - spot.middle) / spot.radius_px, 4.0));
    };
    const auto found = Track(tracker.get(), RenderMarkers(camera, {marker}, options));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].detection.id, 1465);
    EXPECT_LT(CornerRms(found[0], TrueCorners(camera, marker)), 0.2);
  }
}

}  // namespace
}  // namespace pleinair::tracker
