// `pleinair sky` from outside: its pictures as other programs read them, its tables, its refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

json RunJson(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "sky");
  arguments.emplace_back("--json");
  const RunResult run = RunPleinair(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1) << run.out;
  return json::parse(run.out, nullptr, false);
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<double> Numbers(const std::string& line) {
  std::vector<double> numbers;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) numbers.push_back(std::stod(field));
  return numbers;
}

/// A picture of light: blue, green, red floats.
cv::Mat ReadLight(const fs::path& file) {
  setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1);  // OpenCV asks for it before it reads OpenEXR.
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

/// Mean direction of the light above half the maximum, by a program's own map from a place in the
/// picture (u from the left, v from the bottom, both 0 to 1) to its world.
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
    RunJson({"--sun", std::to_string(azimuth_deg) + "," + std::to_string(elevation_deg), "--model",
             "perez", "--disc", "--size", "1024", "-o", file});
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

/// What a latitude-longitude map sheds on level ground, and all its light taken together.
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
  const std::vector<std::string> sky = {"--sun",  "200,35", "--model", "perez",
                                        "--size", "512",    "-o",      folder / "a.exr"};
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
  const std::vector<std::string> sky = {"--sun", "200,35", "--model", "perez", "--size", "64"};
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
    RunJson({"--sun", "200,35", "--model", "perez", "--size", "128", "-o", folder / name});
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
  RunJson({"--sun", "225,30", "--model", "perez", "--size", "400", "-o", folder / "a.png"});
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
  EXPECT_GT(opposite[0], opposite[2] + 20);  // The far sky is blue.
  EXPECT_EQ(picture.at<cv::Vec3b>(3, 3), cv::Vec3b(0, 0, 0));
}

TEST(Sky, ExposesAsItIsTold) {
  const TemporaryFolder folder;
  const auto mean_green = [&](const std::string& ev) {
    const json told = RunJson({"--sun", "225,30", "--model", "perez", "--size", "64", "--exposure",
                               ev, "-o", folder / "a.png"});
    EXPECT_NEAR(told.at("picture").at("ev100").get<double>(), std::stod(ev), 1e-9);
    // ISO 12232, saturation-based: 1.2 cd/m2 at EV 0.
    EXPECT_NEAR(
        told.at("picture").at("gain_per_cd_m2").get<double>() * 1.2 * std::exp2(std::stod(ev)), 1.0,
        1e-9);
    return cv::mean(cv::imread((folder / "a.png").string()))[1];
  };
  EXPECT_GT(mean_green("12"), mean_green("14") + 20.0);
  const json automatic =
      RunJson({"--sun", "225,30", "--model", "perez", "--size", "64", "-o", folder / "a.png"});
  // Sunny 16: EV 15 for the scene; a camera that looks at the sky alone opens further.
  EXPECT_NEAR(automatic.at("picture").at("ev100").get<double>(), 13.0, 1.0);
}

TEST(Sky, TellsTheIlluminancesOfAPlaceAndATime) {
  const json noon =
      RunJson({"--at", "50.0875,14.4213", "--time", "2025-09-14T11:05:00Z", "--model", "perez"});
  EXPECT_NEAR(noon.at("sun_azimuth_deg").get<double>(), 182.4589, 1e-3);
  EXPECT_NEAR(noon.at("sun_elevation_deg").get<double>(), 43.1195, 1e-3);
  const double sky = noon.at("sky_horizontal_lux"), sun = noon.at("sun_horizontal_lux");
  EXPECT_NEAR(noon.at("global_horizontal_lux").get<double>(), sky + sun, 0.1);
  EXPECT_NEAR(noon.at("diffuse_share").get<double>(), sky / (sky + sun), 1e-4);
  EXPECT_NEAR(sun / noon.at("sun_normal_lux").get<double>(), std::sin(43.1195 * M_PI / 180.0),
              1e-4);
  const json same = RunJson({"--sun", "182.458881,43.119512", "--model", "perez"});
  // --sun stands at 1 au; on that day it was 1.00583 au away.
  EXPECT_NEAR(same.at("sky_horizontal_lux").get<double>() / sky, 1.00583 * 1.00583, 1e-3);
}

TEST(Sky, AnswersForEveryDirectionOfATable) {
  const TemporaryFolder folder;
  std::string table = "id,elevation_deg,azimuth_deg\n";
  constexpr int kRings = 30, kSectors = 36;
  for (int ring = 0; ring < kRings; ++ring) {
    // Equal projected solid angles.
    const double elevation = std::asin(std::sqrt((ring + 0.5) / kRings)) * 180.0 / M_PI;
    for (int sector = 0; sector < kSectors; ++sector) {
      table += "7," + std::to_string(elevation) + "," + std::to_string(10 * sector + 5) + "\n";
    }
  }
  WriteFile(folder / "in.csv", table);
  for (const char* model : {"perez", "cie:1", "cie:12"}) {
    const json told = RunJson({"--sun", "180,40", "--model", model});
    const RunResult run =
        RunPleinair({"sky", "--sun", "180,40", "--model", model, "--csv", folder / "in.csv"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::vector<std::string> lines = Lines(run.out);
    ASSERT_EQ(lines.size(), 1u + kRings * kSectors);
    EXPECT_EQ(lines[0], "id,elevation_deg,azimuth_deg,luminance_cd_m2,x,y,r,g,b");
    double sum = 0.0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::vector<double> row = Numbers(lines[i]);
      ASSERT_EQ(row.size(), 9u);
      EXPECT_EQ(row[0], 7.0);
      EXPECT_NEAR((0.2126 * row[6] + 0.7152 * row[7] + 0.0722 * row[8]) / row[3], 1.0, 1e-3);
      EXPECT_GT(row[4], 0.2);
      EXPECT_LT(row[4], 0.45);
      sum += row[3];
    }
    const double illuminance = sum * M_PI / (kRings * kSectors);
    EXPECT_NEAR(illuminance / told.at("sky_horizontal_lux").get<double>(), 1.0, 0.01) << model;
  }
}

TEST(Sky, ScalesACieSky) {
  const json bright =
      RunJson({"--sun", "180,40", "--model", "cie:5", "--zenith-luminance", "5000"});
  EXPECT_NEAR(bright.at("zenith_luminance_cd_m2").get<double>(), 5000.0, 1.0);
  EXPECT_NEAR(bright.at("sky_horizontal_lux").get<double>(), 5000.0 * M_PI, 50.0);
  const json level = RunJson({"--sun", "180,40", "--model", "cie:1", "--sky-illuminance", "9000"});
  EXPECT_NEAR(level.at("sky_horizontal_lux").get<double>(), 9000.0, 9.0);
}

TEST(Sky, TabulatesADay) {
  const RunResult run =
      RunPleinair({"sky", "--at", "50.0875,14.4213", "--day", "2025-06-21", "--utc-offset",
                   "+02:00", "--step", "3600", "--model", "perez"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = Lines(run.out);
  ASSERT_EQ(lines.size(), 26u);  // Both midnights.
  EXPECT_THAT(lines[0], StartsWith("utc,sun_azimuth_deg,sun_elevation_deg,sky_horizontal_lux"));
  EXPECT_THAT(lines[1], StartsWith("2025-06-20T22:00:00Z,"));
  EXPECT_THAT(lines[25], StartsWith("2025-06-21T22:00:00Z,"));
  EXPECT_THAT(run.out, Not(HasSubstr(",nan")));
}

/// How many pictures an MP4 holds: its sample size box (ISO 14496-12, 8.7.3).
int CountFrames(const std::string& mp4) {
  const std::size_t at = mp4.find("stsz");
  if (at == std::string::npos || at + 16 > mp4.size()) return -1;
  int count = 0;
  for (std::size_t i = at + 12; i < at + 16; ++i) {
    count = count * 256 + static_cast<unsigned char>(mp4[i]);
  }
  return count;
}

TEST(Sky, FilmsADay) {
  const TemporaryFolder folder;
  const std::vector<std::string> film = {"--at",    "50.0875,14.4213",
                                         "--from",  "2025-09-14T04:00:00Z",
                                         "--to",    "2025-09-14T18:00:00Z",
                                         "--step",  "3600",
                                         "--model", "perez",
                                         "--size",  "96",
                                         "--fps",   "10"};
  std::vector<std::string> first = film, again = film;
  first.insert(first.end(), {"-o", folder / "a.mp4"});
  again.insert(again.end(), {"-o", folder / "b.mp4"});
  EXPECT_EQ(RunJson(first).at("frames"), 15);
  RunJson(again);
  const std::string bytes = ReadFile(folder / "a.mp4");
  EXPECT_EQ(CountFrames(bytes), 15);
  EXPECT_EQ(ReadFile(folder / "b.mp4"), bytes);
  EXPECT_EQ(Listing(folder.path()).size(), 2u);
}

TEST(Sky, IsFiniteInTheNight) {
  const TemporaryFolder folder;
  for (const char* model : {"perez", "cie:12", "atmosphere"}) {
    for (const char* sun : {"10,-4", "10,-12", "10,-45", "0,-90"}) {
      RunJson({"--sun", sun, "--model", model, "--size", "32", "-o", folder / "a.exr"});
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

// Clouds dim the sun and even out the sky; the default model is the atmosphere.
TEST(Sky, CloudsTakeTheSunAway) {
  const json clear = RunJson({"--sun", "180,40"});
  const json half = RunJson({"--sun", "180,40", "--cloud-cover", "0.5"});
  const json closed = RunJson({"--sun", "180,40", "--cloud-cover", "1"});
  EXPECT_EQ(clear.at("model"), "atmosphere");
  EXPECT_LT(half.at("sun_normal_lux").get<double>(), clear.at("sun_normal_lux").get<double>());
  EXPECT_LT(closed.at("sun_normal_lux").get<double>(), 1.0);
  EXPECT_GT(closed.at("diffuse_share").get<double>(), 0.999);
  EXPECT_GT(half.at("diffuse_share").get<double>(), clear.at("diffuse_share").get<double>());
}

TEST(Sky, LooksRedAtALowSunAndBlueAtTheZenith) {
  const TemporaryFolder folder;
  WriteFile(folder / "in.csv", "azimuth_deg,elevation_deg\n270,2\n270,20\n90,90\n");
  const RunResult run = RunPleinair({"sky", "--sun", "270,2", "--csv", folder / "in.csv"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = Lines(run.out);
  ASSERT_EQ(lines.size(), 4u);
  const std::vector<double> at_sun = Numbers(lines[1]), above = Numbers(lines[2]);
  const std::vector<double> zenith = Numbers(lines[3]);
  EXPECT_GT(at_sun[2], 3.0 * above[2]);   // The glow around the sun.
  EXPECT_GT(at_sun[5], 2.0 * at_sun[7]);  // Red over blue.
  EXPECT_GT(zenith[7], 1.3 * zenith[5]);  // Blue over red.
  const json low = RunJson({"--sun", "270,2"});
  const std::vector<double> sun = low.at("sun_normal_rgb");
  EXPECT_GT(sun[0], 4.0 * sun[2]);
}

TEST(Sky, TakesTheAirItself) {
  const std::vector<std::string> air = {"--sun",
                                        "180,30",
                                        "--aerosol-beta",
                                        "0.03",
                                        "--aerosol-alpha",
                                        "1.1",
                                        "--aerosol-height",
                                        "1200",
                                        "--aerosol-albedo",
                                        "0.93",
                                        "--aerosol-asymmetry",
                                        "0.78",
                                        "--albedo",
                                        "0.15"};
  const json moderate = RunJson(air);
  std::vector<std::string> hazy = air;
  hazy[3] = "0.2";
  EXPECT_LT(RunJson(hazy).at("sun_normal_lux").get<double>(),
            0.8 * moderate.at("sun_normal_lux").get<double>());
}

TEST(Sky, WarnsWhereAModelCannotHaveTheTurbidity) {
  const RunResult run =
      RunPleinair({"sky", "--sun", "180,30", "--model", "perez", "--turbidity", "1.5", "--json"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("turbidity"));
  EXPECT_THAT(json::parse(run.out).at("notes").at(0).get<std::string>(), HasSubstr("turbidity"));
}

TEST(Sky, HasAHelpWithExamples) {
  const RunResult run = RunPleinair({"sky", "--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, AllOf(HasSubstr("Examples:"), HasSubstr("--turbidity"),
                             HasSubstr("--projection"), HasSubstr("three.js")));
}

/// A command line that cannot be carried out, and what the one line of error must name.
struct Refusal {
  const char* name;
  std::vector<std::string> arguments;
  std::string message;
};

void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

class SkyRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(SkyRefusal, IsOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "out");
  std::vector<std::string> arguments = {"sky"};
  for (std::string word : GetParam().arguments) {
    const std::size_t at = word.find("OUT");
    if (at != std::string::npos) word.replace(at, 3, (folder / "out").string());
    arguments.push_back(word);
  }
  const RunResult run = RunPleinair(arguments);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_THAT(run.err, AllOf(StartsWith("pleinair: "), HasSubstr(GetParam().message)));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(Listing(folder / "out"), IsEmpty());
}

const std::string kPlace = "50,14";
const std::string kNoon = "2025-09-14T11:05:00Z";

INSTANTIATE_TEST_SUITE_P(
    BadInput, SkyRefusal,
    ::testing::Values(
        Refusal{"Nothing", {"-o", "OUT/a.png"}, "needs a place and a time"},
        Refusal{"Latitude", {"--at", "91,0", "--time", kNoon, "-o", "OUT/a.png"}, "lat \"91\""},
        Refusal{"ImpossibleDate",
                {"--at", kPlace, "--time", "2025-02-30T00:00:00Z", "-o", "OUT/a.png"},
                "names a day that does not exist"},
        Refusal{"ImpossibleDay",
                {"--at", kPlace, "--day", "2025-13-01", "--utc-offset", "Z", "-o", "OUT/a.mp4"},
                "is not a day"},
        Refusal{"DayWithoutClock",
                {"--at", kPlace, "--day", "2025-06-21", "-o", "OUT/a.mp4"},
                "--utc-offset"},
        Refusal{"TurbidityTooHigh",
                {"--sun", "180,30", "--turbidity", "1000", "-o", "OUT/a.png"},
                "turbidity 1000 is impossible"},
        Refusal{"TurbidityNegative",
                {"--sun", "180,30", "--turbidity=-2", "-o", "OUT/a.png"},
                "turbidity -2 is impossible"},
        Refusal{"TurbidityNan",
                {"--sun", "180,30", "--turbidity", "nan", "-o", "OUT/a.png"},
                "turbidity"},
        Refusal{"UnknownModel",
                {"--sun", "180,30", "--model", "hosek", "-o", "OUT/a.png"},
                "unknown sky model \"hosek\""},
        Refusal{"Cie16", {"--sun", "180,30", "--model", "cie:16", "-o", "OUT/a.png"}, "\"16\""},
        Refusal{"Cie0", {"--sun", "180,30", "--model", "cie:0", "-o", "OUT/a.png"}, "\"0\""},
        Refusal{"CloudsWithCie",
                {"--sun", "180,30", "--model", "cie:1", "--cloud-cover", "0.5", "-o", "OUT/a.png"},
                "cloud cover"},
        Refusal{"TooManyClouds",
                {"--sun", "180,30", "--cloud-cover", "1.5", "-o", "OUT/a.png"},
                "cloud cover 1.5 is impossible"},
        Refusal{"WhiterThanWhiteGround",
                {"--sun", "180,30", "--albedo", "1.2", "-o", "OUT/a.png"},
                "albedo 1.2 is impossible"},
        Refusal{"AerosolForPerez",
                {"--sun", "180,30", "--model", "perez", "--aerosol-beta", "0.1", "-o", "OUT/a.png"},
                "aerosol"},
        Refusal{"SunAboveTheZenith", {"--sun", "180,95", "-o", "OUT/a.png"}, "180,95"},
        Refusal{"SunNan", {"--sun", "nan,30", "-o", "OUT/a.png"}, "nan,30"},
        Refusal{"SunWithPlace",
                {"--sun", "180,30", "--at", kPlace, "--time", kNoon, "-o", "OUT/a.png"},
                "--sun"},
        Refusal{"UnknownPicture",
                {"--sun", "180,30", "--model", "perez", "-o", "OUT/a.tiff"},
                "a.tiff: is no kind of picture"},
        Refusal{"VideoOfOneMoment",
                {"--sun", "180,30", "--model", "perez", "-o", "OUT/a.mp4"},
                "a video of one moment"},
        Refusal{"VideoOfADayInOneStep",
                {"--at", kPlace, "--day", "2025-06-21", "--utc-offset", "Z", "--step", "1e9",
                 "--model", "perez", "--size", "64", "-o", "OUT/a.mp4"},
                "a video of one moment"},
        Refusal{"PictureOfManyMoments",
                {"--at", kPlace, "--day", "2025-06-21", "--utc-offset", "Z", "--model", "perez",
                 "-o", "OUT/a.png"},
                "one picture for many moments"},
        Refusal{"UnknownProjection",
                {"--sun", "180,30", "--projection", "cube", "-o", "OUT/a.png"},
                "--projection"},
        Refusal{"OddMap",
                {"--sun", "180,30", "--model", "perez", "--size", "101", "-o", "OUT/a.exr"},
                "even number"},
        Refusal{
            "HugePicture", {"--sun", "180,30", "--size", "100000", "-o", "OUT/a.png"}, "--size"},
        Refusal{"NanExposure",
                {"--sun", "180,30", "--exposure", "nan", "-o", "OUT/a.png"},
                "--exposure"},
        Refusal{"NoFolder",
                {"--sun", "180,30", "--model", "perez", "--size", "32", "-o", "OUT/none/a.exr"},
                "a.exr: cannot write"},
        Refusal{"NoFolderForVideo",
                {"--at", kPlace, "--from", kNoon, "--to", "2025-09-14T12:05:00Z", "--model",
                 "perez", "--size", "32", "-o", "OUT/none/a.mp4"},
                "a.mp4: cannot write"},
        Refusal{
            "BackwardSpan",
            {"--at", kPlace, "--from", kNoon, "--to", "2025-09-13T00:00:00Z", "-o", "OUT/a.mp4"},
            "lies before"},
        Refusal{"NoStep",
                {"--at", kPlace, "--from", kNoon, "--to", kNoon, "--step", "0", "-o", "OUT/a.mp4"},
                "--step"},
        Refusal{"TableIntoAPicture",
                {"--sun", "180,30", "--model", "perez", "--csv", "-", "-o", "OUT/a.exr"},
                "a.exr: is the name of a picture"},
        Refusal{"NoSuchTable",
                {"--sun", "180,30", "--model", "perez", "--csv", "OUT/none.csv", "-o", "OUT/a.csv"},
                "none.csv: cannot read"}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

TEST(Sky, NamesTheLineOfABrokenTableAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string good = "azimuth_deg,elevation_deg\n180,45\n";
  for (const std::string broken :
       {"180,91\n", "180\n", "180,1,2\n", "south,30\n", "180,nan\n", "180,\n", "400,10\n"}) {
    WriteFile(folder / "in.csv", good + broken + "10,20\n");
    for (const bool to_file : {false, true}) {
      std::vector<std::string> arguments = {"sky",   "--sun", "180,30",         "--model",
                                            "perez", "--csv", folder / "in.csv"};
      if (to_file) arguments.insert(arguments.end(), {"-o", folder / "out.csv"});
      const RunResult run = RunPleinair(arguments);
      EXPECT_EQ(run.exit_code, 2) << broken;
      EXPECT_THAT(run.err, HasSubstr("in.csv:3: ")) << broken;
      EXPECT_THAT(run.out, IsEmpty()) << broken;
      EXPECT_THAT(Listing(folder.path()), ElementsAre("in.csv"));
    }
  }
  WriteFile(folder / "in.csv", "azimuth_deg,height\n1,2\n");
  EXPECT_THAT(
      RunPleinair({"sky", "--sun", "180,30", "--model", "perez", "--csv", folder / "in.csv"}).err,
      HasSubstr("in.csv:1: the column elevation_deg is missing"));
}

TEST(Sky, LeavesNothingOfAnInterruptedFilm) {
  const TemporaryFolder folder;
  const std::string out = folder / "a.mp4";
  // Once it has begun to write (or, should it never, after a while).
  const RunResult run = RunCommandLine(
      {"sh", "-c",
       std::string(PLEINAIR_PROGRAM) +
           " sky --at 50,14 --day 2025-06-21 --utc-offset Z --step 60 --size 256 --model perez -o "
           "'" +
           out + "' & n=0; until ls '" + folder.path().string() +
           "'/.a.part* >/dev/null 2>&1 || [ $((n += 1)) -gt 5000 ]; do :; done; kill -INT $!; "
           "wait $!"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_THAT(run.err, AllOf(StartsWith("pleinair: "), HasSubstr("a.mp4: interrupted")));
  EXPECT_THAT(Listing(folder.path()), IsEmpty());
}

TEST(Sky, ReportsAFullDisk) {
  for (const char* name : {"a.exr", "a.hdr", "a.png", "a.mp4"}) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = {"sky",
                                          "--at",
                                          "50,14",
                                          "--model",
                                          "perez",
                                          "--size",
                                          "256",
                                          "-o",
                                          folder / name,
                                          "--time",
                                          "2025-06-21T12:00:00Z"};
    if (std::string(name) == "a.mp4") {
      arguments.insert(arguments.end(), {"--until", "2025-06-21T18:00:00Z", "--step", "300"});
    }
    const RunResult run = RunPleinair(arguments, "ulimit -f 4;");
    EXPECT_EQ(run.exit_code, 1) << name << " " << run.err;
    EXPECT_THAT(run.err, AllOf(HasSubstr(name), HasSubstr("File too large"))) << name;
    EXPECT_THAT(Listing(folder.path()), IsEmpty()) << name;
  }
}

}  // namespace
}  // namespace pleinair::e2e
