// Tests that other programs read the maps and images of `pleinair sky` correctly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// An image of light: blue, green, red floats.
cv::Mat ReadLight(const fs::path& file) {
  setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1);  // OpenCV requires this before it reads OpenEXR.
  cv::Mat picture = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(picture.type(), CV_32FC3) << file;
  return picture;
}

double LuminanceAt(const cv::Mat& picture, int row, int column) {
  const auto& bgr = picture.at<cv::Vec3f>(row, column);
  return 0.0722 * bgr[0] + 0.7152 * bgr[1] + 0.2126 * bgr[2];
}

struct Vector {
  double x, y, z;
};

/// Mean direction of the light above half the maximum. `direction_of` is another program's map from
/// image position (u from the left, v from the bottom, 0 to 1) to direction.
template <typename DirectionOf>
Vector CentreOfTheBrightest(const cv::Mat& picture, const DirectionOf& direction_of) {
  double highest = 0.0;
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      highest = std::max(highest, LuminanceAt(picture, row, column));
    }
  }
  Vector sum{0.0, 0.0, 0.0};
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const double light = LuminanceAt(picture, row, column);
      if (light < 0.5 * highest) continue;
      const Vector d =
          direction_of((column + 0.5) / picture.cols, 1.0 - (row + 0.5) / picture.rows);
      sum = {sum.x + light * d.x, sum.y + light * d.y, sum.z + light * d.z};
    }
  }
  const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  return {sum.x / length, sum.y / length, sum.z / length};
}

// Blender, Cycles kernel, equirectangular_range_to_direction with its default range: z up.
Vector BlenderDirection(double u, double v) {
  const double phi = -2.0 * M_PI * u + M_PI;
  const double theta = -M_PI * v + M_PI;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// three.js, common.glsl, equirectUv: u = atan(z, x) / 2 pi + 1/2, v = asin(y) / pi + 1/2; inverted.
// y up.
Vector ThreeJsDirection(double u, double v) {
  const double elevation = (v - 0.5) * M_PI;
  const double turn = (u - 0.5) * 2.0 * M_PI;
  return {std::cos(elevation) * std::cos(turn), std::sin(elevation),
          std::cos(elevation) * std::sin(turn)};
}

double DegreesBetween(Vector a, Vector b) {
  return std::acos(std::min(1.0, a.x * b.x + a.y * b.y + a.z * b.z)) * 180.0 / M_PI;
}

class SkyMap : public ::testing::TestWithParam<std::string> {};

TEST_P(SkyMap, HasItsSunWhereBlenderAndThreeJsExpectIt) {
  const TemporaryFolder folder;
  for (const auto& [azimuth_deg, elevation_deg] :
       {std::pair{230.0, 25.0}, std::pair{15.0, 60.0}, std::pair{110.0, 4.0}}) {
    const fs::path file = folder / ("map" + GetParam());
    RunJson({"sky", "--sun", std::to_string(azimuth_deg) + "," + std::to_string(elevation_deg),
             "--model", "perez", "--disc", "--size", "1024", "-o", file});
    const cv::Mat picture = ReadLight(file);
    ASSERT_EQ(picture.cols, 1024);
    ASSERT_EQ(picture.rows, 512);
    const double a = azimuth_deg * M_PI / 180.0, e = elevation_deg * M_PI / 180.0;
    const double east = std::cos(e) * std::sin(a), north = std::cos(e) * std::cos(a);
    const double up = std::sin(e);
    // Blender's x is east, y north, z up; three.js' x is east, y up, z south.
    EXPECT_LT(DegreesBetween(CentreOfTheBrightest(picture, BlenderDirection), {east, north, up}),
              0.15);
    EXPECT_LT(DegreesBetween(CentreOfTheBrightest(picture, ThreeJsDirection), {east, up, -north}),
              0.15);
  }
}

INSTANTIATE_TEST_SUITE_P(Sky, SkyMap, ::testing::Values(".exr", ".hdr"),
                         [](const auto& ending) { return ending.param.substr(1); });

/// Irradiance of a latitude-longitude map on level ground, and its total light.
struct MapLight {
  double horizontal_lx = 0.0, total = 0.0;
};

MapLight Integrate(const cv::Mat& map) {
  MapLight light;
  const double step = 2.0 * M_PI / map.cols;
  for (int row = 0; row < map.rows / 2; ++row) {
    const double z = (row + 0.5) * step;
    for (int column = 0; column < map.cols; ++column) {
      const double part = LuminanceAt(map, row, column) * std::sin(z) * step * step;
      light.total += part;
      light.horizontal_lx += part * std::cos(z);
    }
  }
  return light;
}

TEST(Sky, MapHoldsTheLightThatTheJsonTells) {
  const TemporaryFolder folder;
  const std::vector<std::string> sky = {"sky",    "--sun", "200,35", "--model",       "perez",
                                        "--size", "512",   "-o",     folder / "a.exr"};
  const json told = RunJson(sky);
  const MapLight without = Integrate(ReadLight(folder / "a.exr"));
  EXPECT_NEAR(without.horizontal_lx / told.at("sky_horizontal_lux").get<double>(), 1.0, 0.01);
  std::vector<std::string> with_disc = sky;
  with_disc.emplace_back("--disc");
  RunJson(with_disc);
  const cv::Mat map = ReadLight(folder / "a.exr");
  const MapLight with = Integrate(map);
  EXPECT_NEAR((with.total - without.total) / told.at("sun_normal_lux").get<double>(), 1.0, 1e-3);
  EXPECT_NEAR(
      (with.horizontal_lx - without.horizontal_lx) / told.at("sun_horizontal_lux").get<double>(),
      1.0, 0.01);
  // The ground below: diffuse, reflectance 0.15.
  EXPECT_NEAR(LuminanceAt(map, 200, 100),
              0.15 / M_PI * told.at("global_horizontal_lux").get<double>(), 5.0);
}

TEST(Sky, ScalesTheValuesOfAMap) {
  const TemporaryFolder folder;
  const std::vector<std::string> sky = {"sky",   "--sun",  "200,35", "--model",
                                        "perez", "--size", "64"};
  for (const auto& [name, scale] : {std::pair{"a.exr", "1"}, std::pair{"b.exr", "0.001"}}) {
    std::vector<std::string> arguments = sky;
    arguments.insert(arguments.end(), {"--scale", scale, "-o", folder / name});
    RunJson(arguments);
  }
  EXPECT_NEAR(LuminanceAt(ReadLight(folder / "a.exr"), 10, 10) /
                  LuminanceAt(ReadLight(folder / "b.exr"), 10, 10),
              1000.0, 0.01);
}

TEST(Sky, RadianceFileHoldsWhatOpenExrHolds) {
  const TemporaryFolder folder;
  for (const char* name : {"a.exr", "a.hdr"}) {
    RunJson({"sky", "--sun", "200,35", "--model", "perez", "--size", "128", "-o", folder / name});
  }
  const cv::Mat exr = ReadLight(folder / "a.exr"), hdr = ReadLight(folder / "a.hdr");
  for (int row = 0; row < exr.rows; ++row) {
    for (int column = 0; column < exr.cols; ++column) {
      const double a = LuminanceAt(exr, row, column), b = LuminanceAt(hdr, row, column);
      ASSERT_NEAR(b / a, 1.0, 0.02) << row << " " << column;
    }
  }
  EXPECT_THAT(ReadFile(folder / "a.hdr").substr(0, 200),
              AllOf(StartsWith("#?RADIANCE\n"), HasSubstr("FORMAT=32-bit_rle_rgbe")));
}

TEST(Sky, FisheyeShowsTheSunInTheSouthWestLowerRight) {
  const TemporaryFolder folder;
  RunJson({"sky", "--sun", "225,30", "--model", "perez", "--size", "400", "-o", folder / "a.png"});
  const cv::Mat picture = cv::imread((folder / "a.png").string());
  ASSERT_EQ(picture.cols, 400);
  ASSERT_EQ(picture.rows, 400);
  // North up, east left: south-west is lower right; equidistant: 60 of 90 degrees from the zenith.
  const double r = 200.0 * 60.0 / 90.0 * std::sqrt(0.5);
  const cv::Vec3b sun = picture.at<cv::Vec3b>(static_cast<int>(200 + r), static_cast<int>(200 + r));
  const cv::Vec3b opposite =
      picture.at<cv::Vec3b>(static_cast<int>(200 - r), static_cast<int>(200 - r));
  EXPECT_GT(sun[1], 200);
  EXPECT_GT(sun[1], opposite[1] + 40);
  EXPECT_GT(opposite[0], opposite[2] + 20);  // The sky opposite the sun is blue.
  EXPECT_EQ(picture.at<cv::Vec3b>(3, 3), cv::Vec3b(0, 0, 0));
}

TEST(Sky, IsFiniteInTheNight) {
  const TemporaryFolder folder;
  for (const char* model : {"perez", "cie:12", "atmosphere"}) {
    for (const char* sun : {"10,-4", "10,-12", "10,-45", "0,-90"}) {
      RunJson({"sky", "--sun", sun, "--model", model, "--size", "32", "-o", folder / "a.exr"});
      const cv::Mat map = ReadLight(folder / "a.exr");
      for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.cols; ++column) {
          const double light = LuminanceAt(map, row, column);
          ASSERT_TRUE(std::isfinite(light) && light >= 0.0) << model << " " << sun;
        }
      }
    }
  }
}

TEST(Sky, ExposesAsItIsTold) {
  const TemporaryFolder folder;
  const auto mean_green = [&](const std::string& ev) {
    const json told = RunJson({"sky", "--sun", "225,30", "--model", "perez", "--size", "64",
                               "--exposure", ev, "-o", folder / "a.png"});
    EXPECT_NEAR(told.at("picture").at("ev100").get<double>(), std::stod(ev), 1e-9);
    // ISO 12232, saturation-based: 1.2 cd/m2 at EV 0.
    EXPECT_NEAR(
        told.at("picture").at("gain_per_cd_m2").get<double>() * 1.2 * std::exp2(std::stod(ev)), 1.0,
        1e-9);
    return cv::mean(cv::imread((folder / "a.png").string()))[1];
  };
  EXPECT_GT(mean_green("12"), mean_green("14") + 20.0);
  const json automatic = RunJson(
      {"sky", "--sun", "225,30", "--model", "perez", "--size", "64", "-o", folder / "a.png"});
  // Sunny 16: EV 15 for the scene; a camera that sees only the sky needs less exposure.
  EXPECT_NEAR(automatic.at("picture").at("ev100").get<double>(), 13.0, 1.0);
}

}  // namespace
}  // namespace pleinair::e2e
