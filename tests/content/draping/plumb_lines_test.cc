#include "content/draping/plumb_lines.h"

#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <utility>
#include <vector>

#include "content/draping/chord_error.h"
#include "tests/content/draping/made_surfaces.h"

namespace pleinair::content {
namespace {

// Ground that rises away from the marker: the point on it has the longitude and latitude of the
// map.
TEST(PlumbLines, KeepLongitudeAndLatitude) {
  tests::MeshMaker maker;
  maker.Field(40, 2500.0, [](double x, double y) { return 0.1 * x - 0.05 * y + 30.0; });
  const auto index = SurfaceIndex::Create(maker.Take());
  ASSERT_TRUE(index);
  const LocalFrame frame({14.4213, 50.0875, 220.0});
  std::vector<GeodeticPoint> geodetic;
  std::vector<Point<World>> points;
  for (const double east : {-0.025, 0.0, 0.01, 0.025}) {
    for (const double north : {-0.015, 0.002, 0.015}) {
      geodetic.push_back({14.4213 + east, 50.0875 + north, 220.0});
      points.push_back(frame.EastNorthUp(geodetic.back()));
    }
  }
  geodetic.push_back({14.6, 50.0875, 220.0});  // Over no surface.
  points.push_back(frame.EastNorthUp(geodetic.back()));
  const std::vector<Point<World>> before = points;
  MoveAlongPlumbLines(frame, *index, {}, geodetic, points);
  const GeographicLib::LocalCartesian independent(50.0875, 14.4213, 220.0);
  double largest_shift_m = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3& at = points[i].xyz;
    const double z = *index->HeightAt({at.x, at.y}, {});
    double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
    independent.Reverse(at.x, at.y, z, latitude_deg, longitude_deg, height_m);
    EXPECT_NEAR(latitude_deg, geodetic[i].latitude_deg, 2e-10);  // 0.02 mm.
    EXPECT_NEAR(longitude_deg, geodetic[i].longitude_deg, 3e-10);
    largest_shift_m =
        std::max(largest_shift_m, std::hypot(at.x - before[i].xyz.x, at.y - before[i].xyz.y));
  }
  EXPECT_GT(largest_shift_m, 0.05);
  EXPECT_EQ(points.back().xyz, before.back().xyz);
}

TEST(ChordError, IsThatOfLinesWithoutVerticesOnEdges) {
  tests::MeshMaker maker;
  maker.Field(2, 2.0, [](double x, double) { return std::fabs(x); });  // A valley.
  const auto index = SurfaceIndex::Create(maker.Take());
  ASSERT_TRUE(index);
  std::vector lines{tests::LineOf({{-1, 0.3, 0}, {1, 0.3, 0}})};
  lines[0].above_m = 0.25;
  DrapedPieces draped = DrapeLines(lines, *index, {});
  EXPECT_NEAR(MaxChordError(lines, draped, *index, {}), 0.0, 1e-12);
  std::erase_if(draped.pieces[0].vertices, [](const DrapedVertex& v) { return !v.of_file; });
  EXPECT_NEAR(MaxChordError(lines, draped, *index, {}), 1.0, 1e-12);
}

}  // namespace
}  // namespace pleinair::content
