// Tests `pleinair flow` as a process: lines and their files, the report, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "base/vector.h"
#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/netcdf_writer.h"

namespace pleinair::e2e {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using tests::NetCdfWriter;

using PlaneField = std::function<Vec2(double x, double y)>;

/// Image data of `count` x `count` points from −1 to 1.
std::string SquareVti(int count, const PlaneField& field) {
  const std::string extent =
      "0 " + std::to_string(count - 1) + " 0 " + std::to_string(count - 1) + " 0 0";
  std::string text =
      "<VTKFile type=\"ImageData\" byte_order=\"LittleEndian\">\n<ImageData WholeExtent=\"" +
      extent + "\" Origin=\"-1 -1 0\" Spacing=\"";
  char number[80];
  std::snprintf(number, sizeof number, "%.17g", 2.0 / (count - 1));
  text += std::string(number) + " " + number + " 1\">\n<Piece Extent=\"" + extent +
          "\">\n<PointData Vectors=\"U\">\n<DataArray type=\"Float64\" Name=\"U\" "
          "NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const Vec2 v = field(-1.0 + 2.0 * i / (count - 1), -1.0 + 2.0 * j / (count - 1));
      std::snprintf(number, sizeof number, "%.17g %.17g 0\n", v.x, v.y);
      text += number;
    }
  }
  return text + "</DataArray>\n</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
}

Vec2 Rotation(double x, double y) { return {-y, x}; }

/// Rows of the CSV by line: t_s, x, y, z, speed.
std::map<int, std::vector<std::vector<double>>> RowsOf(const std::string& csv) {
  const std::vector<std::string> lines = Lines(csv);
  EXPECT_EQ(lines.at(0), "line,vertex,t_s,x,y,z,speed_m_s");
  std::map<int, std::vector<std::vector<double>>> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<double> numbers = Numbers(lines[i]);
    auto& line = rows[static_cast<int>(numbers.at(0))];
    EXPECT_EQ(numbers.at(1), static_cast<double>(line.size()));
    line.push_back({numbers.begin() + 2, numbers.end()});
  }
  return rows;
}

TEST(Flow, FollowsStreamlinesOfSeeds) {
  const TemporaryFolder folder;
  WriteFile(folder / "turn.vti", SquareVti(65, Rotation));
  WriteFile(folder / "seeds.csv", "x,y\n0.5,0\n3,3\n0,0.25\n");
  const json out = RunJson(
      {"flow", folder / "turn.vti", "--seeds", folder / "seeds.csv", "-o", folder / "lines.csv"});
  EXPECT_EQ(out.at("lines"), 2);
  EXPECT_EQ(out.at("ends").at("closed"), 2);
  EXPECT_EQ(out.at("ends").at("left"), 0);
  EXPECT_EQ(out.at("levels"), 0);
  EXPECT_GT(out.at("field_reads").get<int>(), 100);
  EXPECT_TRUE(out.at("spacing").is_null());
  EXPECT_THAT(out.at("time_range_s").get<std::vector<double>>(), ElementsAre(0.0, 0.0));
  for (const char* key : {"read", "levels", "integrate"}) {
    EXPECT_GE(out.at("milliseconds").at(key).get<double>(), 0.0);
  }
  const auto rows = RowsOf(ReadFile(folder / "lines.csv"));
  ASSERT_EQ(rows.size(), 2U);
  std::size_t vertices = 0;
  for (const auto& [line, radius] : {std::pair{0, 0.5}, std::pair{2, 0.25}}) {
    for (const std::vector<double>& row : rows.at(line)) {
      EXPECT_NEAR(std::hypot(row[1], row[2]), radius, 1e-5);
      EXPECT_NEAR(row[4], radius, 1e-5);
      ++vertices;
    }
  }
  EXPECT_EQ(out.at("vertices"), vertices);
}

TEST(Flow, WarnsOfSeedsOutside) {
  const TemporaryFolder folder;
  WriteFile(folder / "turn.vti", SquareVti(9, Rotation));
  WriteFile(folder / "seeds.csv", "x,y\n0.5,0\n3,3\n");
  const RunResult some = RunPleinair(
      {"flow", folder / "turn.vti", "--seeds", folder / "seeds.csv", "-o", folder / "lines.csv"});
  EXPECT_EQ(some.exit_code, 0);
  EXPECT_THAT(some.err, HasSubstr("seed 1 lies outside"));
  WriteFile(folder / "seeds.csv", "x,y\n5,0\n3,3\n");
  ExpectRefused(RunPleinair({"flow", folder / "turn.vti", "--seeds", folder / "seeds.csv", "-o",
                             folder / "none.csv"}),
                "all seeds");
  EXPECT_FALSE(std::filesystem::exists(folder / "none.csv"));
}

TEST(Flow, PlacesLinesWithoutSeeds) {
  const TemporaryFolder folder;
  WriteFile(folder / "turn.vti", SquareVti(65, Rotation));
  const json out =
      RunJson({"flow", folder / "turn.vti", "--spacing", "0.1", "-o", folder / "lines.obj"});
  EXPECT_GE(out.at("spacing").at("nearest_min_m").get<double>(), 0.049);
  EXPECT_GE(out.at("spacing").at("covered").get<double>(), 0.98);
  const std::string obj = ReadFile(folder / "lines.obj");
  std::size_t elements = 0, vertices = 0;
  for (const std::string& line : Lines(obj)) {
    elements += line.starts_with("l ") ? 1 : 0;
    vertices += line.starts_with("v ") ? 1 : 0;
  }
  EXPECT_EQ(out.at("lines"), elements);
  EXPECT_EQ(out.at("vertices"), vertices);
  RunJson({"flow", folder / "turn.vti", "-o", folder / "plan.svg"});
  EXPECT_THAT(ReadFile(folder / "plan.svg"), HasSubstr("m/s"));
}

TEST(Flow, ComposesLevels) {
  const TemporaryFolder folder;
  WriteFile(folder / "turn.vti", SquareVti(65, Rotation));
  WriteFile(folder / "seeds.csv", "x,y\n0.4,0\n");
  const double step = 2.0 * std::numbers::pi / 128.0;
  const auto levels = [&](const std::string& method) {
    const json out =
        RunJson({"flow", folder / "turn.vti", "--seeds", folder / "seeds.csv", "--method", method,
                 "--steps", "128", "--step", std::to_string(step), "-o", folder / "lines.csv"});
    EXPECT_EQ(out.at("levels"), method == "rk45" ? 0 : 7);
    EXPECT_EQ(out.at("ends").at("duration"), 1);
    const auto rows = RowsOf(ReadFile(folder / "lines.csv"));
    EXPECT_EQ(rows.at(0).size(), 129U);
    return Vec2{rows.at(0).back()[1] - 0.4, rows.at(0).back()[2]};
  };
  EXPECT_LE(Norm(levels("hierarchical")) * 32.0, 1e-2);
  EXPECT_GE(Norm(levels("hierarchical-nearest")) * 32.0, 2.0);
}

TEST(Flow, WritesGlbAndVtp) {
  const TemporaryFolder folder;
  WriteFile(folder / "turn.vti", SquareVti(17, Rotation));
  WriteFile(folder / "seeds.csv", "x,y\n0.5,0\n0.25,0\n");
  const std::vector<std::string> command{"flow", folder / "turn.vti", "--seeds",
                                         folder / "seeds.csv", "-o"};
  auto with = [&](const std::string& name) {
    std::vector<std::string> all = command;
    all.push_back(folder / name);
    return RunJson(all);
  };
  const json out = with("lines.glb");
  const std::string glb = ReadFile(folder / "lines.glb");
  ASSERT_GT(glb.size(), 20U);
  std::uint32_t length = 0, json_length = 0;
  std::memcpy(&length, &glb[8], 4);
  std::memcpy(&json_length, &glb[12], 4);
  EXPECT_EQ(length, glb.size());
  const json gltf = json::parse(glb.substr(20, json_length));
  EXPECT_EQ(gltf.at("accessors").at(0).at("count"), out.at("vertices"));
  EXPECT_EQ(gltf.at("accessors").at(2).at("count").get<int>(),
            2 * (out.at("vertices").get<int>() - 2));
  EXPECT_EQ(gltf.at("meshes").at(0).at("primitives").at(0).at("mode"), 1);
  with("lines.vtp");
  const std::string vtp = ReadFile(folder / "lines.vtp");
  EXPECT_THAT(vtp, HasSubstr("NumberOfLines=\"2\""));
  EXPECT_THAT(vtp, HasSubstr("Name=\"speed_m_s\""));
}

/// Wind to the east over a degree around 14.4213 E, 50.0875 N, with two times.
std::string EastWind() {
  NetCdfWriter file;
  std::vector<double> latitudes, longitudes;
  for (int i = 0; i <= 40; ++i) {
    latitudes.push_back(49.5875 + 0.025 * i);
    longitudes.push_back(13.9213 + 0.025 * i);
  }
  file.AddAxis("time", {0.0, 1.0}, {{"units", "hours since 2025-09-14T11:00:00Z"}});
  file.AddAxis("lat", latitudes, {{"units", "degrees_north"}});
  file.AddAxis("lon", longitudes, {{"units", "degrees_east"}});
  std::vector<double> east(2 * 41 * 41, 5.0);
  std::fill(east.begin() + 41 * 41, east.end(), 10.0);
  file.AddVariable({"u10",
                    {"time", "lat", "lon"},
                    east,
                    {{"standard_name", "eastward_wind"}, {"units", "m s-1"}}});
  file.AddVariable({"v10",
                    {"time", "lat", "lon"},
                    std::vector<double>(2 * 41 * 41, 0.0),
                    {{"standard_name", "northward_wind"}, {"units", "m s-1"}}});
  return file.Bytes();
}

TEST(Flow, RunsAlongTheAxesOfTheMarkerAsTheHeadingSays) {
  const TemporaryFolder folder;
  WriteFile(folder / "wind.nc", EastWind());
  WriteFile(folder / "seeds.csv", "lon,lat\n14.4213,50.0875\n");
  const auto azimuth = [&](const std::string& heading) {
    WriteFile(folder / "scene.toml",
              "time = 2025-09-14T11:05:00Z\n[place]\nlatitude_deg = 50.0875\n"
              "longitude_deg = 14.4213\nheight_m = 220\n[marker]\nsize_mm = 480\nheading_deg = " +
                  heading + "\n");
    RunJson({"flow", folder / "wind.nc", "--seeds", folder / "seeds.csv", "--duration", "10",
             "--scene", folder / "scene.toml", "-o", folder / "lines.csv"});
    const auto rows = RowsOf(ReadFile(folder / "lines.csv"));
    const auto &first = rows.at(0).front(), &last = rows.at(0).back();
    EXPECT_NEAR(std::hypot(last[1] - first[1], last[2] - first[2]), 50.0, 0.01);
    EXPECT_NEAR(first[3], 0.0, 1e-3);
    return std::atan2(last[1] - first[1], last[2] - first[2]) * 180.0 / std::numbers::pi;
  };
  // Heading: azimuth of +y. The wind runs to azimuth 90.
  EXPECT_NEAR(azimuth("0"), 90.0, 0.01);
  EXPECT_NEAR(azimuth("90"), 0.0, 0.01);
  EXPECT_NEAR(azimuth("30"), 60.0, 0.01);
}

TEST(Flow, HasMetresFromTheMiddleAndDegreesInGeoJson) {
  const TemporaryFolder folder;
  WriteFile(folder / "wind.nc", EastWind());
  WriteFile(folder / "seeds.csv", "lon,lat\n14.4213,50.0875\n");
  const auto run = [&](const std::string& output, std::vector<std::string> more) {
    more.insert(more.begin(), {"flow", folder / "wind.nc", "--seeds", folder / "seeds.csv", "-o",
                               folder / output});
    return RunJson(more);
  };
  const json out = run("lines.csv", {"--duration", "100"});
  EXPECT_THAT(out.at("time_range_s").get<std::vector<double>>(), ElementsAre(0.0, 3600.0));
  const auto rows = RowsOf(ReadFile(folder / "lines.csv"));
  EXPECT_NEAR(rows.at(0).front()[1], 0.0, 1e-6);
  EXPECT_NEAR(rows.at(0).back()[1], 500.0, 0.01);
  EXPECT_NEAR(rows.at(0).back()[2], 0.0, 0.05);
  run("lines.geojson", {"--duration", "100"});
  const json geo = json::parse(ReadFile(folder / "lines.geojson"));
  const json& coordinates = geo.at("features").at(0).at("geometry").at("coordinates");
  EXPECT_NEAR(coordinates.at(0).at(0).get<double>(), 14.4213, 1e-9);
  EXPECT_NEAR(coordinates.at(0).at(1).get<double>(), 50.0875, 1e-9);
  EXPECT_NEAR(coordinates.back().at(0).get<double>(), 14.4213 + 500.0 / 71565.5, 2e-6);
  // Half an hour later the wind has 7.5 m/s; a moment and its seconds are the same.
  run("a.csv", {"--duration", "100", "--time", "2025-09-14T11:30:00Z"});
  run("b.csv", {"--duration", "100", "--time", "1800"});
  EXPECT_EQ(ReadFile(folder / "a.csv"), ReadFile(folder / "b.csv"));
  EXPECT_NEAR(RowsOf(ReadFile(folder / "a.csv")).at(0).back()[1], 750.0, 0.02);
  // A particle is accelerated: 5 t + ½ (5 / 3600) t².
  run("path.csv", {"--lines", "path", "--duration", "1000"});
  EXPECT_NEAR(RowsOf(ReadFile(folder / "path.csv")).at(0).back()[1], 5000.0 + 694.44, 0.1);
}

TEST(Flow, RefusesWhatItCannotDo) {
  const TemporaryFolder folder;
  WriteFile(folder / "turn.vti", SquareVti(9, Rotation));
  WriteFile(folder / "wind.nc", EastWind());
  WriteFile(folder / "seeds.csv", "x,y\n0.5,0\n");
  const auto flow = [&](std::vector<std::string> options, const std::string& file = "turn.vti",
                        const std::string& output = "lines.csv") {
    options.insert(options.begin(), {"flow", folder / file, "-o", folder / output});
    return RunPleinair(options);
  };
  const std::string seeds = folder / "seeds.csv";
  ExpectRefused(flow({}, "turn.vti", "lines.xyz"), "ending");
  ExpectRefused(flow({}, "none.nc"), "does not exist");
  ExpectRefused(flow({"--seeds", seeds, "--spacing", "0.1"}), "--seeds");
  ExpectRefused(flow({"--lines", "path"}), "seeds");
  ExpectRefused(
      flow({"--method", "hierarchical", "--seeds", seeds, "--steps", "100", "--step", "1"}),
      "power of two");
  ExpectRefused(flow({"--seeds", seeds, "--lines", "streak"}), "--duration");
  ExpectRefused(flow({"--time", "2025-09-14T13:00:00Z"}, "wind.nc"), "2025-09-14T12:00:00Z");
  ExpectRefused(flow({"--time", "soon"}, "wind.nc"), "--time");
  ExpectRefused(flow({"--vectors", "V"}), "U [3 components");
  ExpectRefused(flow({"--seeds", seeds}, "wind.nc"), "lon,lat");
  WriteFile(folder / "seeds.csv", "x,y\n0.5,zero\n");
  ExpectRefused(flow({"--seeds", seeds}), "seeds.csv:2");
  WriteFile(folder / "seeds.csv", "x,y\n");
  ExpectRefused(flow({"--seeds", seeds}), "no seeds");
  EXPECT_FALSE(std::filesystem::exists(folder / "lines.csv"));
}

TEST(Flow, NamesTheCrsThatASceneNeeds) {
  const TemporaryFolder folder;
  WriteFile(folder / "turn.vti", SquareVti(9, Rotation));
  WriteFile(folder / "scene.toml",
            "time = 2025-09-14T11:05:00Z\n[place]\nlatitude_deg = 50.0875\n"
            "longitude_deg = 14.4213\n[marker]\nsize_mm = 480\nheading_deg = 0\n");
  const std::vector<std::string> command{
      "flow", folder / "turn.vti", "--scene", folder / "scene.toml", "-o", folder / "lines.csv"};
  ExpectRefused(RunPleinair(command), "--crs");
  std::vector<std::string> in_marker = command;
  in_marker.insert(in_marker.end(), {"--crs", "marker"});
  EXPECT_EQ(RunPleinair(in_marker).exit_code, 0);
}

// The examples of --help, with files in place of theirs.
TEST(Flow, RunsTheExamplesOfItsHelp) {
  const TemporaryFolder folder;
  WriteFile(folder / "wind.nc", EastWind());
  WriteFile(folder / "river.vti", SquareVti(17, Rotation));
  const std::string help = RunPleinair({"flow", "--help"}).out;
  int examples = 0;
  for (const std::string& line : Lines(help)) {
    if (!line.starts_with("  pleinair flow ")) continue;
    WriteFile(folder / "seeds.csv",
              line.find("river") != std::string::npos ? "x,y\n0.5,0\n" : "lon,lat\n14.4,50.1\n");
    const std::string rest = line.substr(std::string("  pleinair ").size());
    const RunResult run = RunCommandLine(
        {"sh", "-c", "cd '" + folder.path().string() + "' && '" + PleinairProgram() + "' " + rest});
    EXPECT_EQ(run.exit_code, 0) << line << '\n' << run.err;
    ++examples;
  }
  EXPECT_GE(examples, 4);
}

}  // namespace
}  // namespace pleinair::e2e
