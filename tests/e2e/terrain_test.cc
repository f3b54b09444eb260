// Tests `pleinair terrain` as a process: the phantom that it writes, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/vector.h"
#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// A slope in UTM 33N that rises by 0.1 to the east, 100 cells of 2 m around the marker's place.
/// That is 50.0875 N, 14.4213 E (458601.7, 5548519.8 by GeographicLib). Without a CRS file.
std::string Slope() {
  std::ostringstream grid;
  grid << "ncols 100\nnrows 100\nxllcorner 458501.7\nyllcorner 5548419.8\ncellsize 2\n"
          "NODATA_value -9999\n";
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 100; ++column) grid << 200.0 + 0.2 * (column + 0.5) << ' ';
    grid << '\n';
  }
  return grid.str();
}

std::vector<Vec3> VerticesOf(const std::string& file) {
  std::ifstream stream(file);
  std::vector<Vec3> vertices;
  std::string kind;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    Vec3 at;
    if (words >> kind >> at.x >> at.y >> at.z && kind == "v") vertices.push_back(at);
  }
  return vertices;
}

TEST(Terrain, IsAPhantomInMarkerCoordinates) {
  const TemporaryFolder folder;
  WriteFile(folder / "dem.asc", Slope());
  WriteFile(folder / "scene.toml",
            "time = 2025-09-14T11:05:00Z\n[place]\nlatitude_deg = 50.0875\n"
            "longitude_deg = 14.4213\nheight_m = 220\n[marker]\nsize_mm = 480\n"
            "heading_deg = 90\n");
  const json out = RunJson({"terrain", folder / "dem.asc", "--scene", folder / "scene.toml",
                            "--crs", "EPSG:32633", "--radius", "60", "-o", folder / "terrain.obj"});
  EXPECT_EQ(out.at("crs"), "EPSG:32633");
  EXPECT_NEAR(out.at("height_shift_m").get<double>(), 220.0 - 210.0, 0.2);
  EXPECT_LE(out.at("largest_error_m").get<double>(), 0.05);
  const std::vector<Vec3> vertices = VerticesOf(folder / "terrain.obj");
  ASSERT_EQ(vertices.size(), out.at("vertices").get<std::size_t>());
  EXPECT_THAT(ReadFile(folder / "terrain.mtl"), HasSubstr("Kd 0.35 0.33 0.3\n"));
  // The marker faces east: y. The slope rises ahead, and passes through the origin.
  double farthest_m = 0.0;
  for (const Vec3& at : vertices) {
    EXPECT_NEAR(at.z, 0.1 * at.y, 0.1) << at.x << ", " << at.y;
    farthest_m = std::max(farthest_m, std::hypot(at.x, at.y));
  }
  EXPECT_GT(farthest_m, 55.0);
  EXPECT_LE(farthest_m, 60.0);
}

TEST(Terrain, KeepsTheColorThatTheUserGaveIt) {
  const TemporaryFolder folder;
  WriteFile(folder / "dem.asc", Slope());
  WriteFile(folder / "terrain.mtl", "newmtl ground\nKd 0.1 0.2 0.05\n");
  RunJson({"terrain", folder / "dem.asc", "--at", "50.0875,14.4213,220", "--crs", "EPSG:32633",
           "--radius", "20", "-o", folder / "terrain.obj"});
  EXPECT_THAT(ReadFile(folder / "terrain.mtl"), HasSubstr("Kd 0.1 0.2 0.05"));
  EXPECT_THAT(ReadFile(folder / "terrain.obj"), HasSubstr("mtllib terrain.mtl\nusemtl ground\n"));
}

TEST(Terrain, RefusesWhatIsFarUnknownOrNoHeight) {
  const TemporaryFolder folder;
  const auto terrain = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"terrain", folder / "dem.asc"});
    options.insert(options.end(), {"--at", "50.0875,14.4213,220", "-o", folder / "terrain.obj"});
    return RunPleinair(options);
  };
  ExpectRefused(terrain({}), "does not exist");
  WriteFile(folder / "dem.asc", Slope());
  ExpectRefused(terrain({}), "states no coordinate reference system");
  ExpectRefused(terrain({"--crs", "EPSG:32634"}), "km");
  ExpectRefused(terrain({"--crs", "EPSG:32633", "--height", "high"}), "--height");
  ExpectRefused(terrain({"--crs", "EPSG:32633", "--band", "2"}), "no band 2");
  WriteFile(folder / "dem.asc",
            "ncols 1000000000\nnrows 1000000000\nxllcorner 0\nyllcorner 0\n"
            "cellsize 1\n1 2 3\n");
  ExpectRefused(terrain({"--crs", "EPSG:32633"}), "dem.asc");
  EXPECT_FALSE(std::filesystem::exists(folder / "terrain.obj"));
}

}  // namespace
}  // namespace pleinair::e2e
