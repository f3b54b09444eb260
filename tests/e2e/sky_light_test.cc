// Tests the light that `pleinair sky` reports: illuminances, and luminances in directions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Sky, ReportsTheIlluminancesOfAPlaceAndATime) {
  const json noon = RunJson(
      {"sky", "--at", "50.0875,14.4213", "--time", "2025-09-14T11:05:00Z", "--model", "perez"});
  EXPECT_NEAR(noon.at("sun_azimuth_deg").get<double>(), 182.4589, 1e-3);
  EXPECT_NEAR(noon.at("sun_elevation_deg").get<double>(), 43.1195, 1e-3);
  const double sky = noon.at("sky_horizontal_lux"), sun = noon.at("sun_horizontal_lux");
  EXPECT_NEAR(noon.at("global_horizontal_lux").get<double>(), sky + sun, 0.1);
  EXPECT_NEAR(noon.at("diffuse_share").get<double>(), sky / (sky + sun), 1e-4);
  EXPECT_NEAR(sun / noon.at("sun_normal_lux").get<double>(), std::sin(43.1195 * M_PI / 180.0),
              1e-4);
  const json same = RunJson({"sky", "--sun", "182.458881,43.119512", "--model", "perez"});
  // --sun assumes a distance of 1 au; on that day it was 1.00583 au.
  EXPECT_NEAR(same.at("sky_horizontal_lux").get<double>() / sky, 1.00583 * 1.00583, 1e-3);
}

TEST(Sky, AnswersForEveryDirectionOfATable) {
  const TemporaryFolder folder;
  std::string table = "id,elevation_deg,azimuth_deg\n";
  constexpr int kRings = 30, kSectors = 36;
  for (int ring = 0; ring < kRings; ++ring) {
    // Directions of equal projected solid angle.
    const double elevation = std::asin(std::sqrt((ring + 0.5) / kRings)) * 180.0 / M_PI;
    for (int sector = 0; sector < kSectors; ++sector) {
      table += "7," + std::to_string(elevation) + "," + std::to_string(10 * sector + 5) + "\n";
    }
  }
  WriteFile(folder / "in.csv", table);
  for (const char* model : {"perez", "cie:1", "cie:12"}) {
    const json told = RunJson({"sky", "--sun", "180,40", "--model", model});
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
      RunJson({"sky", "--sun", "180,40", "--model", "cie:5", "--zenith-luminance", "5000"});
  EXPECT_NEAR(bright.at("zenith_luminance_cd_m2").get<double>(), 5000.0, 1.0);
  EXPECT_NEAR(bright.at("sky_horizontal_lux").get<double>(), 5000.0 * M_PI, 50.0);
  const json level =
      RunJson({"sky", "--sun", "180,40", "--model", "cie:1", "--sky-illuminance", "9000"});
  EXPECT_NEAR(level.at("sky_horizontal_lux").get<double>(), 9000.0, 9.0);
}

TEST(Sky, TabulatesADay) {
  const RunResult run =
      RunPleinair({"sky", "--at", "50.0875,14.4213", "--day", "2025-06-21", "--utc-offset",
                   "+02:00", "--step", "3600", "--model", "perez"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = Lines(run.out);
  ASSERT_EQ(lines.size(), 26u);  // Both midnights included.
  EXPECT_THAT(lines[0], StartsWith("utc,sun_azimuth_deg,sun_elevation_deg,sky_horizontal_lux"));
  EXPECT_THAT(lines[1], StartsWith("2025-06-20T22:00:00Z,"));
  EXPECT_THAT(lines[25], StartsWith("2025-06-21T22:00:00Z,"));
  EXPECT_THAT(run.out, Not(HasSubstr(",nan")));
}

// Clouds attenuate the sun and make the sky more uniform. The default model is the atmosphere.
TEST(Sky, CloudsTakeTheSunAway) {
  const json clear = RunJson({"sky", "--sun", "180,40"});
  const json half = RunJson({"sky", "--sun", "180,40", "--cloud-cover", "0.5"});
  const json closed = RunJson({"sky", "--sun", "180,40", "--cloud-cover", "1"});
  EXPECT_EQ(clear.at("model"), "atmosphere");
  EXPECT_LT(half.at("sun_normal_lux").get<double>(), clear.at("sun_normal_lux").get<double>());
  EXPECT_LT(closed.at("sun_normal_lux").get<double>(), 1.0);
  EXPECT_GT(closed.at("diffuse_share").get<double>(), 0.999);
  EXPECT_GT(half.at("diffuse_share").get<double>(), clear.at("diffuse_share").get<double>());
}

// E of a slab of τ = 8 below a clear sky, by the table of R(μ₀) and S.
TEST(Sky, HasTheLightOfALayerOfClouds) {
  const json sky = RunJson(
      {"sky", "--sun", "180,30", "--albedo", "0", "--cloud-layer", "kind=slab,optical_depth=8"});
  const double sun = sky.at("clear_sun_normal_lux").get<double>() * 0.5;
  const double above = sky.at("clear_global_horizontal_lux").get<double>() - sun;
  const double expected = sun * (1.0 - 0.5582) + above * (1.0 - 0.4925);
  EXPECT_NEAR(sky.at("global_horizontal_lux").get<double>() / expected, 1.0, 0.02);
  EXPECT_NEAR(sky.at("mean_global_horizontal_lux").get<double>() / expected, 1.0, 0.002);
  EXPECT_NEAR(sky.at("sun_transmittance").get<double>() / std::exp(-16.0), 1.0, 1e-3);
  EXPECT_EQ(sky.at("cloud_layers").at(0).at("kind"), "slab");
  EXPECT_EQ(sky.at("cloud_layers").at(0).at("cover_found"), 1.0);
}

// The shadow moves with the wind; other columns are kept.
TEST(Sky, GivesTheShadowOfCloudsAtPoints) {
  const TemporaryFolder folder;
  std::string table = "id,north_m,east_m,seconds\n";
  for (int i = 0; i < 40; ++i) {
    const std::string north = std::to_string(150 * i);
    table.append("a,").append(north).append(",0,0\nb,").append(north).append(",800,100\n");
  }
  WriteFile(folder / "in.csv", table);
  const RunResult run = RunPleinair({"sky", "--sun", "180,40", "--cloud-layer",
                                     "kind=cumulus,cover=0.3,wind_m_s=8,wind_from_deg=270",
                                     "--shadow-at", folder / "in.csv"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = Lines(run.out);
  ASSERT_EQ(lines.size(), 81u);
  EXPECT_EQ(lines[0], "id,north_m,east_m,seconds,sun_transmittance,sun_normal_lux");
  int lit = 0, shaded = 0;
  for (std::size_t i = 1; i < lines.size(); i += 2) {
    const double before = Numbers(lines[i].substr(2))[3];
    EXPECT_NEAR(Numbers(lines[i + 1].substr(2))[3], before, 2e-3);
    lit += before > 0.9;
    shaded += before < 0.1;
  }
  EXPECT_GT(lit, 5);
  EXPECT_GT(shaded, 5);
  WriteFile(folder / "bad.csv", "east_m,north_m\n0,0\n0,x\n");
  const RunResult bad = RunPleinair({"sky", "--sun", "180,40", "--cloud-layer", "kind=cumulus",
                                     "--shadow-at", folder / "bad.csv"});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.err, HasSubstr("bad.csv:3: north_m \"x\" is not possible"));
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
  const json low = RunJson({"sky", "--sun", "270,2"});
  const std::vector<double> sun = low.at("sun_normal_rgb");
  EXPECT_GT(sun[0], 4.0 * sun[2]);
}

TEST(Sky, TakesTheAirItself) {
  const std::vector<std::string> air = {"sky",    "--sun",
                                        "180,30", "--aerosol-beta",
                                        "0.03",   "--aerosol-alpha",
                                        "1.1",    "--aerosol-height",
                                        "1200",   "--aerosol-albedo",
                                        "0.93",   "--aerosol-asymmetry",
                                        "0.78",   "--albedo",
                                        "0.15"};
  const json moderate = RunJson(air);
  std::vector<std::string> hazy = air;
  hazy[4] = "0.2";
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

}  // namespace
}  // namespace pleinair::e2e
