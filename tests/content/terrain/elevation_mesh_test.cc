// Elevation rasters, written here by the formats' rules, against analytic fields and GeographicLib.
#include "content/terrain/elevation_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>

#include "tests/temporary_folder.h"

namespace pleinair::content {
namespace {

using ::testing::HasSubstr;

const Place kPlace{50.0875, 14.4213, 220.0, HeightReference::kSeaLevel};
constexpr int kNoDataCode = -9999;

/// The height of a cell by its centre, in the CRS.
using Field = std::function<double(double east_m, double north_m)>;

struct Grid {
  double west_m, south_m;  // The outer corner of the first cell of the last row.
  double cell_m;
  int columns, rows;
};

/// A GeoTIFF with 32-bit heights: the tags of the GeoTIFF standard, one strip.
std::string GeoTiff(const Grid& grid, const Field& field, int epsg, bool is_point) {
  std::string cells(static_cast<std::size_t>(grid.columns) * grid.rows * 4, '\0');
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const auto height =
          static_cast<float>(field(grid.west_m + (column + 0.5) * grid.cell_m,
                                   grid.south_m + (grid.rows - row - 0.5) * grid.cell_m));
      std::memcpy(&cells[4 * (static_cast<std::size_t>(row) * grid.columns + column)], &height, 4);
    }
  }
  const auto bytes = [](auto value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  // A tie point names the corner of an area or the centre of a point.
  const double half = is_point ? 0.5 * grid.cell_m : 0.0;
  std::string scale = bytes(grid.cell_m) + bytes(grid.cell_m) + bytes(0.0);
  std::string tie;
  for (const double value :
       {0.0, 0.0, 0.0, grid.west_m + half, grid.south_m + grid.rows * grid.cell_m - half, 0.0}) {
    tie += bytes(value);
  }
  std::string keys;
  for (const int key :
       {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, is_point ? 2 : 1, 3072, 0, 1, epsg}) {
    keys += bytes(static_cast<std::uint16_t>(key));
  }
  const std::string nodata = std::to_string(kNoDataCode) + '\0';
  struct Tag {
    int tag, type;  // 2 text, 3 short, 4 long, 12 double.
    std::string values;
    int count;
  };
  const auto number = [&](int tag, int value) {
    return Tag{tag, 4, bytes(static_cast<std::uint32_t>(value)), 1};
  };
  std::vector<Tag> tags{number(256, grid.columns),
                        number(257, grid.rows),
                        number(258, 32),
                        number(259, 1),
                        number(262, 1),
                        number(273, 0),
                        number(277, 1),
                        number(278, grid.rows),
                        number(279, static_cast<int>(cells.size())),
                        number(339, 3),
                        {33550, 12, scale, 3},
                        {33922, 12, tie, 6},
                        {34735, 3, keys, 16},
                        {42113, 2, nodata, static_cast<int>(nodata.size())}};
  const std::size_t first = 8 + 2 + 12 * tags.size() + 4;
  std::string beside;
  std::string entries = bytes(static_cast<std::uint16_t>(tags.size()));
  std::size_t places = 0;
  for (const Tag& tag : tags) places += tag.values.size() > 4 ? tag.values.size() : 0;
  for (Tag& tag : tags) {
    if (tag.tag == 273) tag.values = bytes(static_cast<std::uint32_t>(first + places));
    entries += bytes(static_cast<std::uint16_t>(tag.tag)) +
               bytes(static_cast<std::uint16_t>(tag.type)) +
               bytes(static_cast<std::uint32_t>(tag.count));
    if (tag.values.size() > 4) {
      entries += bytes(static_cast<std::uint32_t>(first + beside.size()));
      beside += tag.values;
    } else {
      entries += tag.values + std::string(4 - tag.values.size(), '\0');
    }
  }
  return std::string("II\x2a\0\x08\0\0\0", 8) + entries + std::string(4, '\0') + beside + cells;
}

/// A place in UTM 33N.
struct Utm {
  double east_m = 0.0, north_m = 0.0;
};

Utm MarkerInUtm() {
  int zone = 0;
  bool north = true;
  Utm utm;
  GeographicLib::UTMUPS::Forward(kPlace.latitude_deg, kPlace.longitude_deg, zone, north, utm.east_m,
                                 utm.north_m, 33);
  return utm;
}

/// Around the marker, whose place is no cell's centre.
Grid AroundMarker(double cell_m, int cells) {
  const Utm marker = MarkerInUtm();
  return {marker.east_m - (0.37 + 0.5 * cells) * cell_m,
          marker.north_m - (0.21 + 0.5 * cells) * cell_m, cell_m, cells, cells};
}

class TerrainOfRaster : public ::testing::Test {
 protected:
  Result<ElevationMesh> Triangulated(const std::string& bytes, const TerrainOptions& options) {
    return TriangulateRaster(folder_.Write("dem.tif", bytes), kPlace, options);
  }
  const tests::TemporaryFolder folder_;
};

double Rolling(double east_m, double north_m) {
  const Utm marker = MarkerInUtm();
  return 220.0 +
         3.0 * std::sin(0.02 * (east_m - marker.east_m)) *
             std::cos(0.03 * (north_m - marker.north_m)) +
         0.05 * (east_m - marker.east_m);
}

// Vertices are where an independent library has them, half a cell of points and areas included.
TEST_F(TerrainOfRaster, StandsWhereTheFieldIs) {
  const GeographicLib::LocalCartesian frame(kPlace.latitude_deg, kPlace.longitude_deg,
                                            kPlace.height_m);
  for (const bool is_point : {false, true}) {
    const Grid grid = AroundMarker(4.0, 300);
    const auto mesh =
        Triangulated(GeoTiff(grid, Rolling, 32633, is_point),
                     {.max_error_m = 0.05, .radius_m = 500.0, .height = TerrainHeight::kDatum});
    ASSERT_TRUE(mesh) << mesh.error().Message();
    EXPECT_GT(mesh->triangles.size(), 1000U);
    EXPECT_LE(mesh->remaining_error_m, 0.05);
    double farthest_m = 0.0;
    for (std::size_t i = 0; i < mesh->vertices.size(); i += 7) {
      const Vec3& at = mesh->vertices[i].xyz;
      farthest_m = std::max(farthest_m, std::hypot(at.x, at.y));
      double latitude = 0.0, longitude = 0.0, height_m = 0.0, east_m = 0.0, north_m = 0.0;
      frame.Reverse(at.x, at.y, at.z, latitude, longitude, height_m);
      int zone = 0;
      bool is_north = true;
      GeographicLib::UTMUPS::Forward(latitude, longitude, zone, is_north, east_m, north_m, 33);
      // At a cell's centre, with its height. Numbers of 32 bits have steps of 15 um at 220 m.
      const double column = (east_m - grid.west_m) / grid.cell_m - 0.5;
      const double row = (north_m - grid.south_m) / grid.cell_m - 0.5;
      EXPECT_NEAR(column, std::round(column), 1e-3);
      EXPECT_NEAR(row, std::round(row), 1e-3);
      EXPECT_NEAR(height_m, Rolling(east_m, north_m), 1e-3);
    }
    EXPECT_GT(farthest_m, 480.0);
    EXPECT_LE(farthest_m, 500.0);
  }
}

TEST_F(TerrainOfRaster, ContainsTheCurvatureOfTheEarth) {
  const Grid grid = AroundMarker(20.0, 220);
  const auto mesh = Triangulated(GeoTiff(
                                     grid, [](double, double) { return 220.0; }, 32633, false),
                                 {.max_error_m = 0.01, .radius_m = 2000.0});
  ASSERT_TRUE(mesh) << mesh.error().Message();
  double lowest_m = 0.0;
  for (const Point<World>& vertex : mesh->vertices) lowest_m = std::min(lowest_m, vertex.xyz.z);
  EXPECT_NEAR(lowest_m, -2000.0 * 2000.0 / (2.0 * 6.378e6), 0.01);
  // A level raster is no plane.
  EXPECT_GT(mesh->triangles.size(), 100U);
}

TEST_F(TerrainOfRaster, PassesThroughTheMarkerUnlessAnotherHeightIsAskedFor) {
  const Grid grid = AroundMarker(2.0, 100);
  const auto level = [](double, double) { return 231.5; };
  const std::string file = GeoTiff(grid, level, 32633, false);
  const auto nearest_up = [](const ElevationMesh& mesh) {
    const auto nearer = [](const Point<World>& a, const Point<World>& b) {
      return std::hypot(a.xyz.x, a.xyz.y) < std::hypot(b.xyz.x, b.xyz.y);
    };
    return std::ranges::min_element(mesh.vertices, nearer)->xyz.z;
  };
  TerrainOptions options{.max_error_m = 0.001, .radius_m = 80.0};
  const auto at_marker = Triangulated(file, options);
  ASSERT_TRUE(at_marker) << at_marker.error().Message();
  EXPECT_NEAR(nearest_up(*at_marker), 0.0, 1e-3);
  EXPECT_NEAR(at_marker->shift_m, -11.5, 1e-3);
  options.height = TerrainHeight::kDatum;
  options.raised_by_m = 0.25;
  const auto raised = Triangulated(file, options);
  ASSERT_TRUE(raised);
  EXPECT_NEAR(nearest_up(*raised), 11.75, 1e-3);
}

TEST_F(TerrainOfRaster, LeavesHolesWhereThereAreNoData) {
  const Utm marker = MarkerInUtm();
  const auto with_hole = [&](double east_m, double north_m) {
    const double off = std::hypot(east_m - marker.east_m - 30.0, north_m - marker.north_m);
    return off < 10.0 ? kNoDataCode : Rolling(east_m, north_m);
  };
  const auto mesh = Triangulated(GeoTiff(AroundMarker(1.0, 200), with_hole, 32633, false),
                                 {.max_error_m = 0.05, .radius_m = 90.0});
  ASSERT_TRUE(mesh) << mesh.error().Message();
  double area_m2 = 0.0;
  for (const auto& [a, b, c] : mesh->triangles) {
    const Vec3 &p = mesh->vertices[a].xyz, &q = mesh->vertices[b].xyz, &r = mesh->vertices[c].xyz;
    const double twice = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    EXPECT_GT(twice, 0.0);  // Counter-clockwise from above.
    area_m2 += 0.5 * twice;
    for (const Vec3& corner : {p, q, r}) EXPECT_GT(std::hypot(corner.x - 30.0, corner.y), 9.5);
  }
  // The disc without the hole and without half of the cells at the borders.
  EXPECT_NEAR(area_m2, 3.1416 * (90.0 * 90.0 - 10.0 * 10.0), 600.0);
}

TEST_F(TerrainOfRaster, RefusesWhatIsFarDamagedOrHasNoHeightAtTheMarker) {
  Grid far = AroundMarker(1.0, 50);
  far.west_m += 40000.0;
  const auto expect = [&](const std::string& bytes, const TerrainOptions& options,
                          const std::string& text) {
    const auto mesh = Triangulated(bytes, options);
    ASSERT_FALSE(mesh) << text;
    EXPECT_THAT(mesh.error().Message(), HasSubstr(text));
    EXPECT_THAT(mesh.error().Message(), HasSubstr("dem.tif"));
  };
  const std::string good = GeoTiff(AroundMarker(1.0, 50), Rolling, 32633, false);
  expect(GeoTiff(far, Rolling, 32633, false), {}, "40.0 km east");
  expect(good.substr(0, good.size() / 2), {}, "damaged");
  expect("not a raster", {}, "no raster");
  expect(good, {.band = 2}, "no band 2");
  Grid beside = AroundMarker(1.0, 50);
  beside.west_m += 30.0;
  const std::string east = GeoTiff(beside, Rolling, 32633, false);
  expect(east, {}, "no data at the marker");
  EXPECT_TRUE(Triangulated(east, {.height = TerrainHeight::kDatum}));
}

}  // namespace
}  // namespace pleinair::content
