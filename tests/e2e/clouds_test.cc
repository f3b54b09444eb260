// Clouds of a recording from the command line.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr const char* kHeader =
    "frame,timestamp_s,sun_r,sun_g,sun_b,sky_r,sky_g,sky_b,sun_to_sky,sun_to_sky_error,source\n";
constexpr const char* kReport =
    R"({"place_time": {"latitude_deg": 50.0875, "longitude_deg": 14.4213, "height_m": 200,
        "start": "2025-09-14T11:05:00Z"}})";

std::string Row(int frame, double seconds, double sun, double sky, const char* source) {
  return fmt::format(
      "{0},{1:.6f},{2:.6g},{2:.6g},{2:.6g},{3:.6g},{3:.6g},{3:.6g},{4:.6g},0.03,{5}\n", frame,
      seconds, sun, sky, sky > 0.0 ? sun / sky : 0.0, source);
}

/// The folder of a replay with that light, of one source.
void WriteReplay(const std::filesystem::path& folder, const std::vector<double>& suns,
                 const char* source, double sky = 0.1) {
  std::filesystem::create_directories(folder);
  std::string rows = kHeader;
  for (std::size_t i = 0; i < suns.size(); ++i) {
    const auto frame = static_cast<int>(i);
    rows += Row(frame, 0.5 * frame, suns[i], sky, source);
  }
  WriteFile(folder / "light.csv", rows);
  WriteFile(folder / "report.json", kReport);
}

// The film's clouds are those of `sky`, of another seed and wind than those that are fitted.
TEST(Clouds, PassInStepWithTheFilm) {
  const TemporaryFolder folder;
  const std::vector<std::string> sky = {
      "sky",
      "--at",
      "50.0875,14.4213",
      "--time",
      "2025-09-14T11:05:00Z",
      "--cloud-layer",
      "kind=cumulus,cover=0.45,wind_m_s=9,wind_from_deg=300,seed=505"};
  constexpr int kFrames = 120;
  std::string points = "east_m,north_m,seconds\n";
  for (int i = 0; i < kFrames; ++i) points += fmt::format("0,0,{}\n", i);
  WriteFile(folder / "points.csv", points);
  std::vector<std::string> at_points = sky;
  at_points.insert(at_points.end(), {"--shadow-at", folder / "points.csv"});
  const RunResult shadows = RunPleinair(at_points);
  ASSERT_EQ(shadows.exit_code, 0) << shadows.err;
  const std::vector<std::string> lines = Lines(shadows.out);
  ASSERT_EQ(lines.size(), 1u + kFrames);
  std::vector<double> suns, skies;
  double rise = 0.0;
  for (int i = 0; i < kFrames; i += 20) {
    std::vector<std::string> at = sky;
    at.insert(at.end(), {"--seconds", std::to_string(i)});
    const json light = RunJson(at);
    rise = std::sin(light.at("sun_elevation_deg").get<double>() * M_PI / 180.0);
    skies.push_back(light.at("sky_horizontal_lux"));
  }
  skies.push_back(skies.back());
  std::string rows = kHeader;
  for (int i = 0; i < kFrames; ++i) {
    const double part = i % 20 / 20.0;
    const double skylight = skies[i / 20] * (1.0 - part) + skies[i / 20 + 1] * part;
    suns.push_back(Numbers(lines[i + 1])[3]);
    rows += Row(i, i, 1e-5 * suns.back() * 100'000.0 * rise, 1e-5 * skylight, "surfaces");
  }
  std::filesystem::create_directories(folder / "out");
  WriteFile(folder / "out/light.csv", rows);
  WriteFile(folder / "out/report.json", kReport);
  const RunResult run =
      RunPleinair({"clouds", folder / "out", "--json", "-o", folder / "layer.toml", "--csv",
                   folder / "course.csv", "--wind-m-s", "12"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json found = json::parse(run.out);
  EXPECT_EQ(found.at("outcome"), "passing");
  EXPECT_LE(found.at("light_rms").get<double>(), 0.1);
  EXPECT_LE(found.at("sun_rms").get<double>(), 0.1);
  EXPECT_EQ(found.at("cloud_layer").at("wind_m_s"), 12);
  EXPECT_LT(found.at("cover").at("low"), found.at("cover").at("high"));
  EXPECT_THAT(found.at("assumed").dump(), HasSubstr("wind_from_deg"));
  const std::string toml = ReadFile(folder / "layer.toml");
  EXPECT_THAT(toml, HasSubstr("[[cloud_layer]]\nkind = \"cumulus\"\n"));
  EXPECT_THAT(toml, HasSubstr("[cloud_layer.passing]\n"));
  EXPECT_THAT(toml, HasSubstr("# Assumed: kind, wind_from_deg, base_m, thickness_m.\n"));
  const std::vector<std::string> course = Lines(ReadFile(folder / "course.csv"));
  ASSERT_EQ(course.size(), 1u + kFrames);
  // A scene takes the layer as it is.
  WriteFile(folder / "scene.toml", toml + "[broken");
  const RunResult broken =
      RunPleinair({"check", BundledRecording(), "--scene", folder / "scene.toml"});
  EXPECT_THAT(broken.err, HasSubstr(fmt::format("scene.toml:{}", Lines(toml).size() + 1)));
}

TEST(Clouds, AreNotFoundInSteadyLight) {
  const TemporaryFolder folder;
  std::vector<double> suns(60, 0.55);
  for (std::size_t i = 0; i < suns.size(); i += 3) suns[i] = 0.56;
  WriteReplay(folder / "out", suns, "surfaces");
  const RunResult run = RunPleinair({"clouds", folder / "out", "-o", folder / "layer.toml"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, HasSubstr("no clouds found"));
  EXPECT_FALSE(std::filesystem::exists(folder / "layer.toml"));
  EXPECT_EQ(RunJson({"clouds", folder / "out"}).at("outcome"), "no clouds");
  // Thin cloud: half of the sun, all the time.
  WriteReplay(folder / "thin", std::vector<double>(60, 0.14), "surfaces");
  const RunResult thin = RunPleinair({"clouds", folder / "thin"});
  EXPECT_EQ(thin.exit_code, 0) << thin.err;
  EXPECT_THAT(thin.out, HasSubstr("[[cloud_layer]]\nkind = \"slab\"\ncover = 1\n"));
}

// A recording is replayed first. The bundled one has a clear sky.
TEST(Clouds, FollowTheLightOfARecordingFirst) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 36, true);
  const RunResult run = RunPleinair({"clouds", folder / "site"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, HasSubstr("no clouds found"));
}

TEST(Clouds, RefuseWhatShowsNoClouds) {
  const TemporaryFolder folder;
  std::vector<double> suns(60, 0.5);
  for (std::size_t i = 20; i < 40; ++i) suns[i] = 0.05;
  WriteReplay(folder / "total", suns, "total only");
  ExpectRefused(RunPleinair({"clouds", folder / "total"}), "known in total only");
  WriteReplay(folder / "held", suns, "held");
  ExpectRefused(RunPleinair({"clouds", folder / "held"}), "--light-changes follow");
  WriteReplay(folder / "stated", suns, "layers");
  ExpectRefused(RunPleinair({"clouds", folder / "stated"}), "stated layers");
  WriteReplay(folder / "short", {0.5, 0.5, 0.1}, "surfaces");
  ExpectRefused(RunPleinair({"clouds", folder / "short"}), "3 frames");
  WriteReplay(folder / "night", suns, "surfaces");
  WriteFile(folder / "night/report.json",
            std::string(kReport).replace(std::string(kReport).find("T11:05"), 6, "T23:05"));
  ExpectRefused(RunPleinair({"clouds", folder / "night"}), "sun below 2°");
  WriteReplay(folder / "place", suns, "surfaces");
  WriteFile(folder / "place/report.json", "{}");
  ExpectRefused(RunPleinair({"clouds", folder / "place"}), "does not state place and time");
  std::filesystem::remove(folder / "place/light.csv");
  ExpectRefused(RunPleinair({"clouds", folder / "place"}), "has no light.csv");
  WriteReplay(folder / "broken", suns, "surfaces");
  WriteFile(folder / "broken/light.csv", std::string(kHeader) + Row(0, 0.0, 1.0, 1.0, "surfaces") +
                                             "1,0.5,x,1,1,1,1,1,1,0.1,surfaces\n");
  ExpectRefused(RunPleinair({"clouds", folder / "broken"}), "light.csv:3: sun_r");
  ExpectRefused(RunPleinair({"clouds", folder / "total", "--kind", "slab"}), "never changes");
  ExpectRefused(RunPleinair({"clouds", folder / "total", "--kind", "nimbus"}), "nimbus");
  ExpectRefused(RunPleinair({"clouds", folder / "total", "--wind-m-s", "0"}), "wind-m-s");
  ExpectRefused(RunPleinair({"clouds", folder / "nowhere"}), "nowhere");
}

}  // namespace
}  // namespace pleinair::e2e
