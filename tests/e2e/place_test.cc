// Tests `pleinair place` as a process: where features stand, plans, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kAt = "50.0875,14.4213,220";

/// A GeoJSON file of geometries, each with the name "f0", "f1", …
std::string GeoJson(const std::vector<std::string>& geometries, const std::string& crs = "") {
  std::string features;
  for (std::size_t i = 0; i < geometries.size(); ++i) {
    features += (i > 0 ? "," : "") +
                (R"({"type":"Feature","properties":{"name":"f)" + std::to_string(i)) +
                R"("},"geometry":)" + geometries[i] + "}";
  }
  const std::string member =
      crs.empty() ? "" : R"("crs":{"type":"name","properties":{"name":")" + crs + R"("}},)";
  return R"({"type":"FeatureCollection",)" + member + R"("features":[)" + features + "]}";
}

std::string PointAt(double x, double y) {
  return json{{"type", "Point"}, {"coordinates", {x, y}}}.dump();
}

/// The scale of the ellipsoid of WGS 84 at 50.0875 degrees, metres per degree (meridian and
/// parallel; radii of curvature M and N at 220 m).
constexpr double kMetresPerDegreeNorth = 111234.590;
constexpr double kMetresPerDegreeEast = 71568.009;

TEST(Place, StatesDistanceAndDirectionOfPoints) {
  const TemporaryFolder folder;
  WriteFile(folder / "map.geojson",
            GeoJson({PointAt(14.4213, 50.0885), PointAt(14.4203, 50.0875)}));
  const json out = RunJson({"place", folder / "map.geojson", "--at", kAt});
  const json& north = out.at("features").at(0);
  EXPECT_NEAR(north.at("nearest").at("distance_m").get<double>(), 1e-3 * kMetresPerDegreeNorth,
              0.01);
  EXPECT_NEAR(std::remainder(north.at("nearest").at("azimuth_deg").get<double>(), 360.0), 0.0,
              1e-6);
  EXPECT_EQ(north.at("name"), "f0");
  const json& west = out.at("features").at(1);
  EXPECT_NEAR(west.at("nearest").at("azimuth_deg").get<double>(), 270.0, 1e-3);
  EXPECT_NEAR(west.at("east_m").at(0).get<double>(), -1e-3 * kMetresPerDegreeEast, 0.01);
  EXPECT_NEAR(west.at("up_m").at(0).get<double>(), 0.0, 1e-3);
  EXPECT_EQ(out.at("nearest").at("feature"), 1);
}

// The same point in UTM 33N (by GeographicLib's UTMUPS) and in degrees.
TEST(Place, PutsDegreesAndGridAtTheSamePlace) {
  const TemporaryFolder folder;
  WriteFile(folder / "degrees.geojson", GeoJson({PointAt(14.44, 50.10)}));
  const json degrees = RunJson({"place", folder / "degrees.geojson", "--at", kAt});
  const double east = degrees.at("features").at(0).at("east_m").at(0).get<double>();
  const double north = degrees.at("features").at(0).at("north_m").at(0).get<double>();
  WriteFile(folder / "grid.geojson",
            GeoJson({PointAt(459949.8578, 5549899.4096)}, "urn:ogc:def:crs:EPSG::32633"));
  const json grid = RunJson({"place", folder / "grid.geojson", "--at", kAt});
  EXPECT_THAT(grid.at("layers").at(0).at("crs").get<std::string>(), HasSubstr("EPSG:32633"));
  EXPECT_NEAR(grid.at("features").at(0).at("east_m").at(0).get<double>(), east, 1e-3);
  EXPECT_NEAR(grid.at("features").at(0).at("north_m").at(0).get<double>(), north, 1e-3);
}

TEST(Place, MeasuresLinesAndAreasBetweenTheirVertices) {
  const TemporaryFolder folder;
  const std::string line =
      R"({"type":"LineString","coordinates":[[14.4113,50.0885],[14.4313,50.0885]]})";
  const std::string around =
      R"({"type":"Polygon","coordinates":[[[14.42,50.087],[14.423,50.087],[14.423,50.088],)"
      R"([14.42,50.088],[14.42,50.087]]]})";
  const std::string with_hole =
      R"({"type":"Polygon","coordinates":[[[14.42,50.087],[14.423,50.087],[14.423,50.088],)"
      R"([14.42,50.088],[14.42,50.087]],[[14.421,50.0873],[14.4217,50.0873],[14.4217,50.0877],)"
      R"([14.421,50.0877],[14.421,50.0873]]]})";
  WriteFile(folder / "map.geojson", GeoJson({line, around, with_hole}));
  const json out = RunJson({"place", folder / "map.geojson", "--at", kAt});
  const json& features = out.at("features");
  // Its vertices are 724 m away.
  EXPECT_NEAR(features.at(0).at("nearest").at("distance_m").get<double>(),
              1e-3 * kMetresPerDegreeNorth, 0.1);
  EXPECT_TRUE(features.at(1).at("surrounds_marker").get<bool>());
  EXPECT_EQ(features.at(1).at("nearest").at("distance_m"), 0.0);
  EXPECT_EQ(features.at(1).at("kind"), "area");
  EXPECT_FALSE(features.at(2).at("surrounds_marker").get<bool>());
}

TEST(Place, TurnsWithTheHeadingOfTheScene) {
  const TemporaryFolder folder;
  WriteFile(folder / "scene.toml",
            "time = 2025-09-14T11:05:00Z\n[place]\nlatitude_deg = 50.0875\n"
            "longitude_deg = 14.4213\nheight_m = 220\n[marker]\nsize_mm = 480\n"
            "heading_deg = 90\n");
  WriteFile(folder / "map.geojson", GeoJson({PointAt(14.4223, 50.0875)}));
  const json out = RunJson({"place", folder / "map.geojson", "--scene", folder / "scene.toml"});
  const json& feature = out.at("features").at(0);
  // What lies east is ahead (+y) of a marker that faces east.
  EXPECT_NEAR(feature.at("marker_y_m").at(0).get<double>(), 1e-3 * kMetresPerDegreeEast, 0.01);
  EXPECT_NEAR(feature.at("marker_x_m").at(0).get<double>(), 0.0, 0.01);
}

TEST(Place, TakesHeightsOfTheMapAndLevelsWhatHasNone) {
  const TemporaryFolder folder;
  WriteFile(folder / "map.geojson",
            GeoJson({R"({"type":"Point","coordinates":[14.4213,50.0876,232.5]})"}));
  const json shared = RunJson({"place", folder / "map.geojson", "--at", kAt});
  EXPECT_NEAR(shared.at("features").at(0).at("up_m").at(0).get<double>(), 12.5, 1e-3);
  EXPECT_EQ(shared.at("layers").at(0).at("heights"), "shared");
  // Above the ellipsoid, whereas the place is above the sea: 45 m of geoid between them.
  const json stated = RunJson({"place", folder / "map.geojson", "--at", kAt, "--crs", "EPSG:4979"});
  EXPECT_EQ(stated.at("layers").at(0).at("heights"), "transformed");
  const double undulation = stated.at("layers").at(0).at("undulation_m").get<double>();
  EXPECT_NEAR(undulation, 45.0, 1.5);
  EXPECT_NEAR(stated.at("features").at(0).at("up_m").at(0).get<double>(), 12.5 - undulation, 1e-3);
}

TEST(Place, WritesVerticesAndPlans) {
  const TemporaryFolder folder;
  WriteFile(folder / "map.geojson",
            GeoJson({R"({"type":"LineString","coordinates":[[14.42,50.088],[14.425,50.089]]})"}));
  const RunResult run = RunPleinair({"place", folder / "map.geojson", "--at", kAt, "--plan",
                                     folder / "plan.svg", "-o", folder / "vertices.csv"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("1 features, 2 vertices"), HasSubstr("north-east")));
  const std::vector<std::string> rows = Lines(ReadFile(folder / "vertices.csv"));
  EXPECT_EQ(rows.at(0), "feature,part,vertex,east_m,north_m,up_m,lon_deg,lat_deg,height_m");
  EXPECT_EQ(Numbers(rows.at(2)).at(2), 1.0);
  EXPECT_NEAR(Numbers(rows.at(2)).at(6), 14.425, 1e-9);
  EXPECT_THAT(ReadFile(folder / "plan.svg"), AllOf(HasSubstr("<svg"), HasSubstr("map.geojson")));
  ASSERT_EQ(
      RunPleinair({"place", folder / "map.geojson", "--at", kAt, "--plan", folder / "plan.png"})
          .exit_code,
      0);
  EXPECT_EQ(cv::imread((folder / "plan.png").string()).cols, 1000);
}

/// A Shapefile of one point (ESRI Shapefile Technical Description, 1998): header and record.
void WriteShapefile(const fs::path& base, double x, double y, const std::string& wkt) {
  const auto big = [](std::string* out, std::uint32_t v) {
    for (int shift = 24; shift >= 0; shift -= 8) *out += static_cast<char>(v >> shift);
  };
  const auto little = [](std::string* out, auto v) {
    std::array<char, sizeof v> bytes{};
    std::memcpy(bytes.data(), &v, sizeof v);
    out->append(bytes.data(), bytes.size());
  };
  const auto header = [&](std::uint32_t words) {
    std::string text;
    big(&text, 9994);
    for (int i = 0; i < 5; ++i) big(&text, 0);
    big(&text, words);
    little(&text, std::uint32_t{1000});
    little(&text, std::uint32_t{1});
    for (const double v : {x, y, x, y, 0.0, 0.0, 0.0, 0.0}) little(&text, v);
    return text;
  };
  std::string shp = header(50 + 4 + 10);
  big(&shp, 1);
  big(&shp, 10);
  little(&shp, std::uint32_t{1});
  little(&shp, x);
  little(&shp, y);
  std::string shx = header(50 + 4);
  big(&shx, 50);
  big(&shx, 10);
  WriteFile(base.string() + ".shp", shp);
  WriteFile(base.string() + ".shx", shx);
  if (!wkt.empty()) WriteFile(base.string() + ".prj", wkt);
}

constexpr const char* kWgs84Prj =
    R"(GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],)"
    R"(PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]])";

TEST(Place, ReadsShapefilesWithTheirProjection) {
  const TemporaryFolder folder;
  WriteShapefile(folder / "map", 14.4213, 50.0885, kWgs84Prj);
  const json out = RunJson({"place", folder / "map.shp", "--at", kAt});
  EXPECT_NEAR(out.at("nearest").at("distance_m").get<double>(), 1e-3 * kMetresPerDegreeNorth, 0.01);
  EXPECT_EQ(out.at("layers").at(0).at("datum_unknown"), false);
}

// Written by the rules of the GeoPackage standard, not by GDAL.
TEST(Place, ReadsGeoPackagesOrSaysThatTheyAreCutShort) {
  const TemporaryFolder folder;
  const fs::path map = folder / "lines.gpkg";
  fs::copy_file(tests::SourceTree() / "tests/fuzz/corpus/map/lines.gpkg", map);
  const json out = RunJson({"place", map, "--at", kAt});
  EXPECT_EQ(out.at("layers").at(0).at("layer"), "pipes");
  EXPECT_THAT(out.at("layers").at(0).at("crs").get<std::string>(), HasSubstr("EPSG:4326"));
  const json& water = out.at("features").at(0);
  EXPECT_EQ(water.at("name"), "water");
  EXPECT_NEAR(water.at("north_m").at(1).get<double>(), 1e-3 * kMetresPerDegreeNorth, 0.01);
  EXPECT_NEAR(water.at("east_m").at(1).get<double>(), 1e-3 * kMetresPerDegreeEast, 0.01);
  for (const std::uintmax_t bytes : {3000U, 700U, 100U, 0U}) {
    fs::resize_file(map, bytes);
    ExpectRefused(RunPleinair({"place", map, "--at", kAt}), "lines.gpkg");
  }
}

TEST(Place, NeedsACrsForAShapefileWithoutOne) {
  const TemporaryFolder folder;
  WriteShapefile(folder / "map", 14.4213, 50.0885, "");
  ExpectRefused(RunPleinair({"place", folder / "map.shp", "--at", kAt}),
                "states no coordinate reference system; give it with --crs");
  const json out = RunJson({"place", folder / "map.shp", "--at", kAt, "--crs", "EPSG:4326"});
  EXPECT_NEAR(out.at("nearest").at("distance_m").get<double>(), 1e-3 * kMetresPerDegreeNorth, 0.01);
  fs::remove(folder / "map.shx");
  ExpectRefused(RunPleinair({"place", folder / "map.shp", "--at", kAt}), "map.shx");
}

TEST(Place, RefusesWhatIsFarSwappedOrDamaged) {
  const TemporaryFolder folder;
  const auto refuse = [&](const std::string& content, const std::string& message,
                          const std::vector<std::string>& more = {}) {
    WriteFile(folder / "map.geojson", content);
    std::vector<std::string> arguments = {"place",  folder / "map.geojson", "--at", kAt,
                                          "--plan", folder / "plan.svg"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ExpectRefused(RunPleinair(arguments), message);
    EXPECT_FALSE(fs::exists(folder / "plan.svg"));
  };
  refuse(GeoJson({PointAt(50.0875, 14.4213)}), "latitude and longitude are swapped");
  refuse(GeoJson({PointAt(16.6068, 49.1951)}), "km south-east");
  refuse(GeoJson({PointAt(1e300, 50.0)}), "feature 0 has a coordinate");
  refuse("{\"type\":\"FeatureCollection\",\"features\":[{", "cannot be read");
  refuse("nothing", "GeoJSON");
  refuse(GeoJson({PointAt(14.4213, 50.0875)}), "has no layer \"roads\"; its layers are: map",
         {"--layer", "roads"});
  refuse(GeoJson({PointAt(14.4213, 50.0875)}), "PROJ knows", {"--crs", "EPSG:99"});
  ExpectRefused(RunPleinair({"place", folder / "none.gpkg", "--at", kAt}), "does not exist");
}

class PlaceRefusal : public ::testing::TestWithParam<Refusal> {};
TEST_P(PlaceRefusal, IsOneLineAndLeavesNothing) { ExpectRefusal("place", GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    BadInput, PlaceRefusal,
    ::testing::Values(Refusal{"NoPlace", {"map.gpkg"}, "needs the place of the marker"},
                      Refusal{"NoNumber", {"map.gpkg", "--at", "50,x"}, "is not a place"},
                      Refusal{"OneNumber", {"map.gpkg", "--at", "50"}, "is not a place"},
                      Refusal{"FourNumbers", {"map.gpkg", "--at", "50,14,2,3"}, "is not a place"},
                      Refusal{"Latitude", {"map.gpkg", "--at", "91,14"}, "is not a place"},
                      Refusal{"Ending",
                              {"map.gpkg", "--at", "50,14", "--plan", "OUT/plan.pdf"},
                              "ends in .svg or .png"},
                      Refusal{
                          "Radius", {"map.gpkg", "--at", "50,14", "--radius", "0"}, "--radius"}),
    [](const auto& each) { return each.param.name; });

TEST(Place, HasAHelpWithExamples) {
  const RunResult run = RunPleinair({"place", "--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, AllOf(HasSubstr("Examples:"), HasSubstr("--plan"), HasSubstr("EPSG:5514")));
}

}  // namespace
}  // namespace pleinair::e2e
