#include "content/georeference/nearness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace pleinair::content {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr Place kPrague{50.0875, 14.4213, 220.0, HeightReference::kEllipsoid};
constexpr double kRadius_m = 2000.0;

std::string Message(const std::string& crs, const std::vector<MapPoint>& points) {
  const auto transform = MapTransform::Create(crs, kPrague, "plan.gpkg");
  if (!transform) return transform.error().Message();
  const auto near = CheckNear(*transform, points, kRadius_m, "plan.gpkg");
  return near ? "" : near.error().Message();
}

TEST(Nearness, PassesContentWithOnePointNear) {
  EXPECT_EQ(Message("EPSG:4326", {{20.0, 50.0, 0.0}, {14.43, 50.09, 0.0}}), "");
  EXPECT_EQ(Message("EPSG:32633", {{458600.0, 5548500.0, 0.0}}), "");
}

TEST(Nearness, StatesDistanceAndDirectionOfTheNearestPoint) {
  // Brno, and Vienna farther away.
  EXPECT_THAT(Message("EPSG:4326", {{16.37, 48.21, 0.0}, {16.6068, 49.1951, 0.0}}),
              AllOf(HasSubstr("plan.gpkg: all of it is farther than 2000 m"),
                    HasSubstr("186.5 km south-east (121 degrees)"), HasSubstr("EPSG:4326")));
}

TEST(Nearness, RecognisesSwappedCoordinates) {
  EXPECT_THAT(Message("EPSG:4326", {{50.0875, 14.4213, 0.0}}),
              HasSubstr("latitude and longitude are swapped"));
  EXPECT_THAT(Message("EPSG:32633", {{5548500.0, 458600.0, 0.0}}),
              HasSubstr("easting and northing are swapped"));
}

TEST(Nearness, RecognisesWrongSigns) {
  const auto transform = MapTransform::Create("EPSG:5514", kPrague, "f");
  ASSERT_TRUE(transform);
  const MapPoint krovak{-742700.0, -1043000.0, 0.0};
  ASSERT_LT(Norm(transform->EastNorthUp(krovak)->xyz), 2000.0);
  EXPECT_THAT(Message("EPSG:5514", {{742700.0, 1043000.0, 0.0}}),
              HasSubstr("negative coordinates here"));
  EXPECT_THAT(Message("EPSG:5514", {{1043000.0, 742700.0, 0.0}}),
              HasSubstr("swapped and have wrong signs"));
  EXPECT_THAT(Message("EPSG:4326", {{-14.4213, -50.0875, 0.0}}), HasSubstr("both signs are wrong"));
}

TEST(Nearness, DoesNotBlameTheAxesOfContentThatIsFarEitherWay) {
  EXPECT_THAT(Message("EPSG:4326", {{0.0, 0.0, 0.0}}),
              AllOf(HasSubstr("km"), testing::Not(HasSubstr("swapped"))));
}

TEST(Nearness, HandlesPointsWithoutAPosition) {
  EXPECT_THAT(Message("EPSG:32633", {{1e300, 0.0, 0.0}}), HasSubstr("no point has a position"));
}

TEST(Nearness, NamesTheNearestPointOfTheCompass) {
  EXPECT_EQ(CompassPoint(0.0), "north");
  EXPECT_EQ(CompassPoint(359.0), "north");
  EXPECT_EQ(CompassPoint(-44.0), "north-west");
  EXPECT_EQ(CompassPoint(200.0), "south");
  EXPECT_EQ(DescribeWay({850.0, 91.0}), "850.0 m east (91 degrees)");
}

}  // namespace
}  // namespace pleinair::content
