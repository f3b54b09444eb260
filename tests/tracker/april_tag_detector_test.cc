#include "tracker/april_tag_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/tracker/marker_rendering.h"

namespace pleinair::tracker {
namespace {

using testing::HasSubstr;

CameraModel Pinhole() {
  return {.width = 200, .height = 160, .fx = 300, .fy = 300, .cx = 99.5, .cy = 79.5};
}

RenderedMarker MarkerAt(const CameraModel& camera, const std::string& family, int id,
                        Vec2 centre_px, double side_px, double roll_deg) {
  RenderedMarker marker;
  marker.pattern = AprilTagPattern(family, id);
  marker.camera_from_marker = PoseAtPixel(camera, centre_px, side_px, marker.size, FromDegrees(20),
                                          FromDegrees(30), FromDegrees(roll_deg));
  return marker;
}

TEST(AprilTagDetector, ReadsEveryFamilyItOffers) {
  const CameraModel camera = Pinhole();
  for (const std::string& family : AprilTagFamilyNames()) {
    SCOPED_TRACE(family);
    const auto detector = CreateAprilTagDetector({family});
    ASSERT_TRUE(detector.has_value());
    const GreyImage image =
        RenderMarkers(camera, {MarkerAt(camera, family, 7, {95, 80}, 80, 10)}, {});
    const std::vector<Candidate> found = (*detector)->Detect(image.view());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].detection.family, family);
    EXPECT_EQ(found[0].detection.id, 7);
  }
}

TEST(AprilTagDetector, GivesCornersInReadingOrderHoweverThePrintIsTurned) {
  const CameraModel camera = Pinhole();
  const auto detector = CreateAprilTagDetector({"tag36h11"});
  for (int roll_deg = 0; roll_deg < 360; roll_deg += 45) {
    SCOPED_TRACE(roll_deg);
    const RenderedMarker marker = MarkerAt(camera, "tag36h11", 3, {100, 78}, 70, roll_deg);
    const std::vector<Candidate> found =
        (*detector)->Detect(RenderMarkers(camera, {marker}, {}).view());
    ASSERT_EQ(found.size(), 1U);
    const std::array<Vec2, 4> truth = TrueCorners(camera, marker);
    for (int i = 0; i < 4; ++i) {
      EXPECT_LT(Norm(found[0].detection.corners_px[i] - truth[i]), 1.0);
    }
  }
}

// A wrong pixel origin gives an offset of half a pixel in both axes. The edge shift towards black,
// an effect of the sRGB curve, nearly cancels in the mean of four corners.
TEST(AprilTagDetector, PutsPixelCentresAtIntegers) {
  const CameraModel camera = Pinhole();
  const auto detector = CreateAprilTagDetector({"tag36h11"});
  Vec2 mean;
  int count = 0;
  for (int i = 0; i < 24; ++i) {
    const RenderedMarker marker =
        MarkerAt(camera, "tag36h11", i, {90 + 0.83 * i, 85 - 0.61 * i}, 50 + i, 15.0 * i);
    const std::vector<Candidate> found =
        (*detector)->Detect(RenderMarkers(camera, {marker}, {}).view());
    ASSERT_EQ(found.size(), 1U);
    const std::array<Vec2, 4> truth = TrueCorners(camera, marker);
    for (int corner = 0; corner < 4; ++corner, ++count) {
      mean = mean + found[0].detection.corners_px[corner] - truth[corner];
    }
  }
  EXPECT_NEAR(mean.x / count, 0.0, 0.15);
  EXPECT_NEAR(mean.y / count, 0.0, 0.15);
}

TEST(AprilTagDetector, FindsNothingInEmptyTinyAndBlankPictures) {
  const auto detector = CreateAprilTagDetector(AprilTagFamilyNames());
  ASSERT_TRUE(detector.has_value());
  EXPECT_TRUE((*detector)->Detect({}).empty());
  for (const int width : {1, 2, 3, 4, 5, 7, 9, 13, 64}) {
    for (const int height : {1, 2, 3, 4, 5, 7, 9, 13, 64}) {
      GreyImage image(width, height);
      EXPECT_TRUE((*detector)->Detect(image.view()).empty()) << width << "x" << height;
      for (int i = 0; i < width * height; ++i) image.data()[i] = static_cast<uint8_t>(i * 37);
      EXPECT_TRUE((*detector)->Detect(image.view()).empty()) << width << "x" << height;
    }
  }
}

TEST(AprilTagDetector, RefusesUnknownFamiliesAndListsTheKnown) {
  const auto detector = CreateAprilTagDetector({"tag36h11", "tag99h1"});
  ASSERT_FALSE(detector.has_value());
  EXPECT_THAT(detector.error().Message(), HasSubstr("tag99h1"));
  EXPECT_THAT(detector.error().Message(), HasSubstr("known are sg, "));
  for (const std::string& known : AprilTagFamilyNames()) {
    EXPECT_THAT(detector.error().Message(), HasSubstr(known));
  }
}

TEST(AprilTagPattern, HasABlackSquareInAWhiteMargin) {
  const auto pattern = AprilTagPattern("tag36h11", 0);
  ASSERT_NE(pattern, nullptr);
  EXPECT_EQ(pattern->modules, 10);
  EXPECT_EQ(pattern->edge_modules, 8);
  ASSERT_EQ(pattern->white.size(), 100U);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(pattern->white[i], 1);
  for (int i = 1; i < 9; ++i) EXPECT_EQ(pattern->white[10 + i], 0);
  EXPECT_EQ(AprilTagPattern("tag36h11", 587), nullptr);
  EXPECT_EQ(AprilTagPattern("tag36h11", -1), nullptr);
  EXPECT_EQ(AprilTagPattern("sg", 0), nullptr);
}

}  // namespace
}  // namespace pleinair::tracker
