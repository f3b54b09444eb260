// Tests `pleinair drape` as a process: files, reports, errors, and places on Earth against
// GeographicLib.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr double kLatitude_deg = 50.0875, kLongitude_deg = 14.4213;

/// A scene with a marker that faces east, sloping ground and a box, and what follows.
std::string SceneWith(const std::string& rest, double heading_deg = 90.0) {
  return "time = 2025-09-14T11:05:00Z\n[place]\nlatitude_deg = 50.0875\n"
         "longitude_deg = 14.4213\nheight_m = 220\n[marker]\nsize_mm = 480\nheading_deg = " +
         std::to_string(heading_deg) + "\n" + rest;
}

/// Ground of 100 m whose height is x / 10 in marker coordinates, and a box of 2 m on it.
constexpr const char* kGround =
    "v -50 -50 -5\nv 50 -50 5\nv 50 50 5\nv -50 50 -5\nf 1 2 3\nf 1 3 4\n";
constexpr const char* kYard =
    "[[phantom]]\nname = \"meadow\"\nfile = \"ground.obj\"\n"
    "[[box]]\nfrom_m = [1, -1, -1]\nto_m = [3, 1, 2]\n";

/// A line over the box in metres of the marker, and an area.
constexpr const char* kPlan = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"status":"new","depth":-1.5},
 "geometry":{"type":"LineString","coordinates":[[-10,0.25],[20,0.25]]}},
{"type":"Feature","properties":{"status":"old","depth":"deep"},
 "geometry":{"type":"Polygon","coordinates":[[[5,5],[9,5],[9,9],[5,5]]]}},
{"type":"Feature","properties":{"status":"old"},"geometry":null},
{"type":"Feature","properties":{"status":"new"},"geometry":{"type":"Point","coordinates":[70,0]}}]})";

class Drape : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteFile(folder_ / "ground.obj", kGround);
    WriteFile(folder_ / "plan.geojson", kPlan);
    WriteFile(folder_ / "camera.json",
              R"({"width":640,"height":480,"fx":500,"fy":500,"cx":319.5,"cy":239.5})");
  }

  void WriteScene(const std::string& drape_keys) const {
    WriteFile(folder_ / "scene.toml",
              SceneWith(std::string(kYard) + "[[drape]]\nfile = \"plan.geojson\"\n" + drape_keys));
  }
  std::vector<std::string> Arguments(const std::string& output,
                                     std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"drape", "--scene", folder_ / "scene.toml", "-o", folder_ / output});
    return more;
  }
  std::vector<std::vector<std::string>> Rows(const std::string& file) const {
    std::vector<std::vector<std::string>> rows;
    const std::vector<std::string> lines = Lines(ReadFile(folder_ / file));
    EXPECT_EQ(lines.at(0), "feature,part,vertex,x_m,y_m,z_m,lon_deg,lat_deg,height_m,from,hidden");
    for (std::size_t i = 1; i < lines.size(); ++i) {
      if (!lines[i].empty()) rows.push_back(Fields(lines[i]));
    }
    return rows;
  }

  TemporaryFolder folder_;
};

TEST_F(Drape, LaysLinesOnPhantomsInMarkerCoordinates) {
  WriteScene("crs = \"marker\"\n");
  const json out = RunJson(Arguments("lines.csv"));
  EXPECT_EQ(out.at("features"), 4);
  EXPECT_EQ(out.at("vertices_in"), 7);
  EXPECT_EQ(out.at("off_target"), 1);
  EXPECT_EQ(out.at("clipped"), 0);
  EXPECT_EQ(out.at("hidden"), 0);
  EXPECT_EQ(out.at("crs"), "marker");
  EXPECT_EQ(out.at("method"), "exact");
  EXPECT_EQ(out.at("height_shift_m"), 0.0);
  EXPECT_LE(out.at("max_chord_error_m").get<double>(), 1e-5);
  for (const char* key : {"read", "project", "drape"}) {
    EXPECT_GE(out.at("milliseconds").at(key).get<double>(), 0.0);
  }
  const auto rows = Rows("lines.csv");
  EXPECT_EQ(out.at("vertices_out"), rows.size());
  bool climbs = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double x = std::stod(rows[i][3]), y = std::stod(rows[i][4]), z = std::stod(rows[i][5]);
    if (rows[i][0] == "0") {
      EXPECT_NEAR(y, 0.25, 1e-6);
    }
    const bool on_box = rows[i][0] == "0" && x > 1.0 - 1e-6 && x < 3.0 + 1e-6;
    const bool at_wall = on_box && (std::fabs(x - 1.0) < 1e-6 || std::fabs(x - 3.0) < 1e-6);
    if (!at_wall) {
      EXPECT_NEAR(z, on_box ? 2.0 : 0.1 * x, 1e-5) << x;
    }
    climbs = climbs || (at_wall && i > 0 && rows[i][3] == rows[i - 1][3] &&
                        std::fabs(std::stod(rows[i - 1][5]) - z) > 1.5);
    EXPECT_EQ(rows[i][10], "0");
  }
  EXPECT_TRUE(climbs);
  EXPECT_EQ(rows.front()[9], "source");
  EXPECT_EQ(rows[1][9], "edge");
  // The ring is closed by its first vertex.
  std::vector<std::vector<std::string>> ring;
  for (const auto& row : rows) {
    if (row[0] == "1") ring.push_back(row);
  }
  ASSERT_GE(ring.size(), 4U);
  EXPECT_EQ(ring.front()[3], ring.back()[3]);
  EXPECT_EQ(ring.front()[5], ring.back()[5]);
}

TEST_F(Drape, FollowsTheRuleOfHeights) {
  const auto first_z = [&](const std::string& keys) {
    WriteScene("crs = \"marker\"\nwhere = \"status = 'new'\"\n" + keys);
    const RunResult run = RunPleinair(Arguments("lines.csv"));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    double highest = -1e9;
    for (const auto& row : Rows("lines.csv")) highest = std::max(highest, std::stod(row[5]));
    return std::pair(std::stod(Rows("lines.csv").at(0)[5]), highest);
  };
  EXPECT_NEAR(first_z("").second, 2.0, 1e-6);
  EXPECT_NEAR(first_z("offset_m = 0.5\n").first, -0.5, 1e-5);
  EXPECT_NEAR(first_z("height_field = \"depth\"\n").first, -2.5, 1e-5);
  EXPECT_NEAR(first_z("height_field = \"depth\"\noffset_m = 0.25\n").first, -2.25, 1e-5);
  // The box reaches below the ground.
  EXPECT_NEAR(first_z("on = \"meadow\"\n").second, 2.0, 1e-4);
  EXPECT_NEAR(first_z("on = \"box 1\"\n").second, 2.0, 1e-6);
}

TEST_F(Drape, WarnsOfEmptyAndMendedFeatures) {
  WriteFile(folder_ / "plan.geojson", R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{},"geometry":null},
{"type":"Feature","properties":{},"geometry":
 {"type":"Polygon","coordinates":[[[5,5],[9,9],[9,5],[5,9],[5,5]]]}}]})");
  WriteScene("crs = \"marker\"\nfill = \"#2060d0\"\n");
  const RunResult run = RunPleinair(Arguments("lines.csv"));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, AllOf(HasSubstr("plan.geojson: feature 1 has rings that cross themselves"),
                             HasSubstr("1 features have no geometry, the first is 0")));
}

// A map in degrees on a terrain of a UTM raster, 2 km around the marker: within 5 mm.
TEST_F(Drape, IsExactOnEarth) {
  std::ostringstream grid;
  grid.precision(12);
  const auto field = [](double east_m, double north_m) {
    return 215.0 + 0.03 * (east_m - 458601.7) - 0.02 * (north_m - 5548519.8);
  };
  const double cell_m = 20.0;
  const int cells = 230;
  const double west_m = 458601.7 - cells * cell_m / 2, south_m = 5548519.8 - cells * cell_m / 2;
  grid << "ncols " << cells << "\nnrows " << cells << "\nxllcorner " << west_m << "\nyllcorner "
       << south_m << "\ncellsize " << cell_m << "\nNODATA_value -9999\n";
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      grid << field(west_m + (column + 0.5) * cell_m, south_m + (cells - row - 0.5) * cell_m)
           << ' ';
    }
    grid << '\n';
  }
  WriteFile(folder_ / "dem.asc", grid.str());
  WriteFile(folder_ / "scene.toml", SceneWith("", 30.0));
  RunJson({"terrain", folder_ / "dem.asc", "--scene", folder_ / "scene.toml", "--crs", "EPSG:32633",
           "--radius", "2150", "--height", "datum", "--max-error", "0.001", "-o",
           folder_ / "ground.obj"});
  std::vector<std::pair<double, double>> places;
  std::string coordinates;
  for (int i = 0; i <= 12; ++i) {
    const double longitude = kLongitude_deg + 0.0245 * std::sin(0.5 * i) * (i > 0);
    const double latitude = kLatitude_deg + 0.0162 * std::cos(0.5 * i) * (i > 0);
    places.emplace_back(longitude, latitude);
    std::ostringstream pair;
    pair.precision(15);
    pair << (i > 0 ? "," : "") << '[' << longitude << ',' << latitude << ']';
    coordinates += pair.str();
  }
  WriteFile(folder_ / "plan.geojson",
            R"({"type":"LineString","coordinates":[)" + coordinates + "]}");
  WriteFile(
      folder_ / "scene.toml",
      SceneWith("[[phantom]]\nfile = \"ground.obj\"\n[[drape]]\nfile = \"plan.geojson\"\n", 30.0));
  const json out = RunJson(Arguments("lines.csv"));
  EXPECT_THAT(out.at("crs").get<std::string>(), HasSubstr("EPSG:4326"));
  EXPECT_EQ(out.at("off_target"), 0);
  EXPECT_LE(out.at("max_chord_error_m").get<double>(), 1e-4);
  const GeographicLib::LocalCartesian tangent(kLatitude_deg, kLongitude_deg, 220.0);
  std::size_t vertex = 0;
  const double s = std::sin(M_PI / 6), c = std::cos(M_PI / 6);
  for (const auto& row : Rows("lines.csv")) {
    if (row[9] != "source") continue;
    const auto [longitude, latitude] = places.at(vertex++);
    EXPECT_NEAR(std::stod(row[6]), longitude, 5e-3 / 71500);
    EXPECT_NEAR(std::stod(row[7]), latitude, 5e-3 / 111200);
    int zone = 0;
    bool is_north = false;
    double east_m = 0.0, north_m = 0.0, convergence = 0.0, scale = 0.0;
    GeographicLib::UTMUPS::Forward(latitude, longitude, zone, is_north, east_m, north_m,
                                   convergence, scale);
    double e = 0.0, n = 0.0, u = 0.0;
    tangent.Forward(latitude, longitude, field(east_m, north_m), e, n, u);
    EXPECT_NEAR(std::stod(row[3]), c * e - s * n, 5e-3);
    EXPECT_NEAR(std::stod(row[4]), s * e + c * n, 5e-3);
    EXPECT_NEAR(std::stod(row[5]), u, 5e-3);
    EXPECT_NEAR(std::stod(row[8]), field(east_m, north_m), 5e-3);
  }
  EXPECT_EQ(vertex, places.size());
}

TEST_F(Drape, WritesFilesOfOtherPrograms) {
  WriteScene("crs = \"marker\"\n");
  for (const char* name : {"lines.geojson", "lines.gpkg", "lines.obj", "lines.glb"}) {
    const RunResult run = RunPleinair(Arguments(name));
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const json map = json::parse(ReadFile(folder_ / "lines.geojson"));
  ASSERT_EQ(map.at("features").size(), 2U);
  EXPECT_EQ(map["features"][0]["geometry"]["type"], "LineString");
  for (const json& point : map["features"][0]["geometry"]["coordinates"]) {
    ASSERT_EQ(point.size(), 3U);
    EXPECT_NEAR(point[0].get<double>(), kLongitude_deg, 1e-3);
    EXPECT_NEAR(point[1].get<double>(), kLatitude_deg, 1e-3);
    EXPECT_NEAR(point[2].get<double>(), 220.0, 5.0);
  }
  // The GeoPackage lies where the map lay.
  const json placed = RunJson({"place", folder_ / "lines.gpkg", "--scene", folder_ / "scene.toml"});
  EXPECT_NEAR(placed.at("features")[0].at("marker_x_m")[0].get<double>(), -10.0, 1e-4);
  EXPECT_NEAR(placed.at("features")[0].at("marker_x_m")[1].get<double>(), 20.0, 1e-4);
  const std::string obj = ReadFile(folder_ / "lines.obj");
  EXPECT_THAT(obj, HasSubstr("v -10.000000 0.250000 -1.000000\n"));
  EXPECT_THAT(obj, HasSubstr("\nl 1 2 3"));
  const std::string glb = ReadFile(folder_ / "lines.glb");
  ASSERT_THAT(glb, StartsWith("glTF"));
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 8, 4);
  EXPECT_EQ(length, glb.size());
  std::memcpy(&length, glb.data() + 12, 4);
  const json gltf = json::parse(glb.substr(20, length));
  EXPECT_NEAR(gltf.at("accessors")[0].at("min")[0].get<double>(), -10.0, 1e-5);
  EXPECT_EQ(gltf.at("meshes")[0].at("primitives")[0].at("mode"), 1);
}

TEST_F(Drape, StatesACrsOfAGeoPackage) {
  WriteScene("crs = \"marker\"\n");
  ASSERT_EQ(RunPleinair(Arguments("lines.gpkg", {"--crs", "EPSG:32633"})).exit_code, 0);
  const json placed = RunJson({"place", folder_ / "lines.gpkg", "--scene", folder_ / "scene.toml"});
  EXPECT_THAT(placed.at("layers")[0].at("crs").get<std::string>(), HasSubstr("EPSG:32633"));
  EXPECT_NEAR(placed.at("features")[0].at("marker_x_m")[1].get<double>(), 20.0, 1e-4);
}

TEST_F(Drape, FlagsWhatTheCameraCannotSee) {
  WriteScene("crs = \"marker\"\nwhere = \"status = 'new'\"\n");
  // Before the box, 1 m above the ground, looking along +x: right is -y, down is -z.
  const std::string view = "-9 0 0.1 -0.5 0.5 -0.5 0.5";
  for (const char* method : {"exact", "screen"}) {
    const json out = RunJson(Arguments("lines.csv", {"--method", method, "--view", view,
                                                     "--calibration", folder_ / "camera.json"}));
    EXPECT_EQ(out.at("method"), method);
    std::size_t hidden = 0;
    for (const auto& row : Rows("lines.csv")) hidden += row[10] == "1" ? 1 : 0;
    EXPECT_EQ(out.at("hidden"), hidden);
    EXPECT_GT(hidden, 0U) << method;
    EXPECT_EQ(Rows("lines.csv").back()[10], "1") << "the ground behind the box";
    EXPECT_NEAR(std::stod(Rows("lines.csv").back()[5]), 2.0, 1e-3);
  }
}

TEST_F(Drape, ChoosesOneOfSeveralDrapesAndNumbersFeaturesOverAll) {
  WriteFile(folder_ / "other.geojson", R"({"type":"Point","coordinates":[-3,4]})");
  WriteScene("crs = \"marker\"\n[[drape]]\nfile = \"other.geojson\"\ncrs = \"marker\"\n");
  EXPECT_EQ(RunJson(Arguments("lines.csv")).at("features"), 5);
  EXPECT_EQ(Rows("lines.csv").back()[0], "4");
  EXPECT_EQ(RunJson(Arguments("lines.csv", {"--drape", "2", "--repeat", "3"})).at("features"), 1);
  EXPECT_EQ(Rows("lines.csv").back()[0], "0");
  ExpectRefused(RunPleinair(Arguments("lines.csv", {"--drape", "3"})), "give 1 to 2");
}

TEST_F(Drape, RefusesWithoutWritingAnything) {
  const auto refuse = [&](const std::string& keys, const std::string& message,
                          std::vector<std::string> more = {},
                          const std::string& output = "lines.csv") {
    WriteScene(keys);
    ExpectRefused(RunPleinair(Arguments(output, std::move(more))), message);
    EXPECT_FALSE(fs::exists(folder_ / output));
  };
  refuse("", "plan.geojson: all of it is farther than 2000 m");  // Metres as degrees.
  refuse("crs = \"EPSG:32633\"\n", "km");
  refuse("crs = \"marker\"\nlayer = \"roads\"\n", "has no layer \"roads\"; its layers are: plan");
  refuse("crs = \"marker\"\nheight_field = \"deep\"\n", "its fields are: status, depth");
  refuse("crs = \"marker\"\nheight_field = \"depth\"\n", "feature 1 has \"deep\" in its field");
  refuse("crs = \"marker\"\nheight_field = \"z\"\n", "feature 0 has no heights");
  refuse("crs = \"marker\"\ncolor_field = \"status\"\n", "feature 0 has \"new\" in its field");
  refuse("crs = \"marker\"\nwhere = \"state = 1\"\n", "cannot be filtered");
  refuse("crs = \"marker\"\n", "is no place of a camera",
         {"--view", "1 2 3", "--calibration", folder_ / "camera.json"});
  refuse("crs = \"marker\"\n", "--view and --calibration belong together",
         {"--view", "1 2 3 0 0 0 1"});
  refuse("crs = \"marker\"\n", "screen needs the place of the camera", {"--method", "screen"});
  refuse("crs = \"marker\"\n", "is for a GeoPackage", {"--crs", "EPSG:32633"});
  refuse("crs = \"marker\"\n", "has no ending of a kind of file", {}, "lines.txt");
  refuse(
      "crs = \"marker\"\non = \"lowest\"\n", "cannot be found on the screen",
      {"--method", "screen", "--view", "0 0 9 1 0 0 0", "--calibration", folder_ / "camera.json"});
  WriteFile(folder_ / "plan.geojson", R"({"type":"Point","coordinates":[300,0]})");
  refuse("crs = \"marker\"\n", "plan.geojson: no surface lies under any vertex");
  WriteFile(folder_ / "plan.csv", "WKT,depth\n\"POINT (1 1)\",2\n");
  WriteFile(folder_ / "scene.toml",
            SceneWith(std::string(kYard) + "[[drape]]\nfile = \"plan.csv\"\n"));
  ExpectRefused(RunPleinair(Arguments("lines.csv")), "states no coordinate reference system");
  WriteFile(folder_ / "scene.toml", SceneWith(kYard));
  ExpectRefused(RunPleinair(Arguments("lines.csv")), "has no [[drape]]");
}

}  // namespace
}  // namespace pleinair::e2e
