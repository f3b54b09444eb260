// Tests `pleinair sun` as a process: its output and its errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
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
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

// Reda & Andreas 2004, Table A5.1.
TEST(Sun, GivesNrelsWorkedExample) {
  const json sun =
      RunJson({"sun", "--at", "39.742476,-105.1786", "--time", "2003-10-17T12:30:30-07:00",
               "--height", "1830.14", "--pressure", "820", "--temperature", "11"});
  EXPECT_NEAR(90.0 - sun.at("elevation_refracted_deg").get<double>(), 50.11162, 0.001);
  EXPECT_NEAR(sun.at("azimuth_deg").get<double>(), 194.34024, 0.001);
  EXPECT_THAT(sun.at("sunrise").get<std::string>(), StartsWith("2003-10-17T13:12:4"));
  EXPECT_THAT(sun.at("noon").get<std::string>(), StartsWith("2003-10-17T18:46:0"));
  EXPECT_THAT(sun.at("sunset").get<std::string>(), StartsWith("2003-10-18T00:18:5"));
  EXPECT_EQ(sun.at("sun"), "rises or sets");
  EXPECT_NEAR(sun.at("angular_radius_deg").get<double>(), 959.63 / 3600.0 / 0.99654, 1e-5);
  EXPECT_NEAR(sun.at("equation_of_time_s").get<double>(), 14.641503 * 60.0, 0.5);
  EXPECT_EQ(sun.at("civil_dawn").get<std::string>().size(),
            std::string("2003-10-17T12:46:00Z").size());
}

TEST(Sun, PrintsAMomentForPeople) {
  const RunResult run =
      RunPleinair({"sun", "--at", "50.0875,14.4213", "--time", "2025-09-14T11:05:00Z"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("azimuth_deg              182.45"),
                             HasSubstr("\nsunrise                  2025-09-14T04:36:"),
                             HasSubstr("\nnoon                     2025-09-14T10:57:"),
                             HasSubstr("\nastronomical_dusk        2025-09-14T19:10:")));
  EXPECT_THAT(run.err, IsEmpty());
}

// At 00:05 summer time the local date is the new day, although solar time is still the previous
// day.
TEST(Sun, TakesTheDayFromTheOffsetOfTheTime) {
  const json meant =
      RunJson({"sun", "--at", "50.0875,14.4213", "--time", "2025-06-21T00:05:00+02:00"});
  EXPECT_THAT(meant.at("noon").get<std::string>(), StartsWith("2025-06-21T11:0"));
  const json solar = RunJson({"sun", "--at", "50.0875,14.4213", "--time", "2025-06-20T22:05:00Z"});
  EXPECT_THAT(solar.at("noon").get<std::string>(), StartsWith("2025-06-20T11:0"));
  const json local = RunJson({"sun", "--at", "50.0875,14.4213", "--time", "2025-06-20T22:05:00Z",
                              "--utc-offset", "+02:00"});
  EXPECT_THAT(local.at("noon").get<std::string>(),
              AllOf(StartsWith("2025-06-21T13:0"), EndsWith("+02:00")));
}

TEST(Sun, ReportsWhyThereIsNoSunrise) {
  const auto text = [](const char* time) {
    return RunPleinair({"sun", "--at", "69.65,18.96", "--time", time}).out;
  };
  EXPECT_THAT(text("2025-06-21T12:00:00Z"),
              AllOf(HasSubstr("sunrise                  none: sun stays up\n"),
                    HasSubstr("sunset                   none: sun stays up\n"),
                    HasSubstr("civil_dawn               none: sun stays above -6 degrees\n")));
  EXPECT_THAT(text("2025-12-21T12:00:00Z"),
              AllOf(HasSubstr("sunrise                  none: sun stays down\n"),
                    HasSubstr("civil_dawn               2025-12-21T0")));
  const json night = RunJson({"sun", "--at", "69.65,18.96", "--time", "2025-12-21T12:00:00Z"});
  EXPECT_TRUE(night.at("sunrise").is_null());
  EXPECT_EQ(night.at("sun"), "stays down");
}

TEST(Sun, ReportsADayWithTwoSunsets) {
  const std::vector<std::string> fairbanks = {"sun",   "--at",       "64.84,-147.72",
                                              "--day", "2025-07-15", "--utc-offset=-08:00"};
  const json day = RunJson(fairbanks);
  std::vector<std::string> names, times;
  for (const json& event : day.at("events")) {
    names.push_back(event.at("event"));
    times.push_back(event.at("time"));
    EXPECT_THAT(times.back(), AllOf(StartsWith("2025-07-15T"), EndsWith("-08:00")));
  }
  EXPECT_THAT(names, ElementsAre("sunset", "midnight", "sunrise", "noon", "sunset"));
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(day.at("sunset"), times.back());  // The sunset after noon.
  EXPECT_EQ(day.at("day"), "2025-07-15");
  EXPECT_NEAR(day.at("day_length_s").get<double>(), 72'224.0, 5.0);
  const RunResult text = RunPleinair(fairbanks);
  EXPECT_THAT(text.out, AllOf(HasSubstr("\nday_length               20:03:4"),
                              HasSubstr("none: sun stays above -6 degrees")));
}

TEST(Sun, ReportsADayWithoutASunset) {
  const RunResult run =
      RunPleinair({"sun", "--at", "64.84,-147.72", "--day", "2025-05-30", "--utc-offset=-08:00"});
  EXPECT_THAT(run.out, AllOf(HasSubstr("sunset                   none on this day\n"),
                             HasSubstr("\nsunrise                  2025-05-30T03:36:")));
}

TEST(Sun, WritesAnAlmanacOfManyDays) {
  const TemporaryFolder folder;
  const RunResult run =
      RunPleinair({"sun", "--at", "50.0875,14.4213", "--day", "2024-02-28", "--days", "3",
                   "--utc-offset", "+01:00", "-o", folder / "a.csv"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = Lines(ReadFile(folder / "a.csv"));
  ASSERT_EQ(lines.size(), 4u);
  const std::size_t columns = Fields(lines[0]).size();
  for (const std::string& line : lines) EXPECT_EQ(Fields(line).size(), columns);
  EXPECT_THAT(lines[2], StartsWith("2024-02-29,+01:00,2024-02-29T0"));
  EXPECT_THAT(lines[3], StartsWith("2024-03-01,+01:00,2024-03-01T0"));
}

TEST(Sun, TabulatesASpanFromToByStep) {
  const std::vector<std::string> long_names = {
      "sun",    "--at", "50,14", "--from", "2025-09-14T00:00:00Z", "--to", "2025-09-14T01:00:00Z",
      "--step", "600"};
  const RunResult run = RunPleinair(long_names);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = Lines(run.out);
  ASSERT_EQ(lines.size(), 8u);  // Header and both ends.
  EXPECT_EQ(lines[0], "utc,lat,lon,azimuth_deg,elevation_deg,elevation_refracted_deg,distance_au");
  EXPECT_THAT(lines[7], StartsWith("2025-09-14T01:00:00Z,50,14,"));
  const RunResult contract = RunPleinair({"sun", "--at", "50,14", "--time", "2025-09-14T00:00:00Z",
                                          "--until", "2025-09-14T01:00:00Z", "--step", "600"});
  EXPECT_EQ(contract.out, run.out);
}

TEST(Sun, AddsItsColumnsToATable) {
  const TemporaryFolder folder;
  WriteFile(folder / "in.csv",
            "id,utc,lat,lon\n\"a, b\",2025-09-14T11:05:00Z,50.0875,14.4213\n"
            "c,2025-09-14T11:05:00Z,-90,0\n");
  const RunResult run = RunPleinair({"sun", "--csv", folder / "in.csv", "-o", folder / "out.csv"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = Lines(ReadFile(folder / "out.csv"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[1], StartsWith("\"a, b\",2025-09-14T11:05:00Z,50.0875,14.4213,182.45"));
  EXPECT_EQ(Fields(lines[2]).size(), 8u);
}

TEST(Sun, ReadsATableFromAPipe) {
  for (const char* name : {"-", "/dev/stdin", "/dev/fd/0"}) {
    const RunResult run = RunPleinair({"sun", "--csv", name},
                                      "printf 'utc,lat,lon\\n2025-06-21T12:00:00Z,50,14\\n' |");
    EXPECT_EQ(run.exit_code, 0) << name << run.err;
    EXPECT_EQ(Lines(run.out).size(), 2U) << name;
  }
}

TEST(Sun, DrawsTheSunPathAsSvgAndPng) {
  const TemporaryFolder folder;
  for (const char* name : {"path.svg", "path.png"}) {
    const json said = RunJson({"sun", "--at", "50.0875,14.4213", "--path", folder / name, "--year",
                               "2025", "--utc-offset", "+01:00", "--size", "600"});
    EXPECT_EQ(said.at("utc_offset"), "+01:00");
  }
  const std::string svg = ReadFile(folder / "path.svg");
  EXPECT_THAT(svg, AllOf(StartsWith("<?xml"), HasSubstr("Sun path 50.0875 N, 14.4213 E, 2025"),
                         HasSubstr(">21 Jun<"), HasSubstr(">21 Dec<"), HasSubstr(">12<"),
                         HasSubstr(">N<"), EndsWith("</svg>\n")));
  const cv::Mat png = cv::imread((folder / "path.png").string());
  ASSERT_EQ(png.cols, 600);
  ASSERT_EQ(png.rows, 654);
  EXPECT_EQ(Listing(folder.path()).size(), 2u);
  // The same result again.
  RunPleinair({"sun", "--at", "50.0875,14.4213", "--path", folder / "again.svg", "--year", "2025",
               "--utc-offset", "+01:00", "--size", "600"});
  EXPECT_EQ(ReadFile(folder / "again.svg"), svg);
}

// Stereographic: r = R tan(z / 2), R = 400 of 1000 units, centre at (500, 550), east right.
TEST(Sun, PutsTheSunsDiscWhereItStands) {
  const TemporaryFolder folder;
  const std::string time = "2025-09-14T14:05:00Z";
  const json sun = RunJson({"sun", "--at", "50.0875,14.4213", "--time", time});
  ASSERT_EQ(RunPleinair({"sun", "--at", "50.0875,14.4213", "--path", folder / "p.png", "--time",
                         time, "--size", "1000"})
                .exit_code,
            0);
  const cv::Mat png = cv::imread((folder / "p.png").string());
  ASSERT_EQ(png.cols, 1000);
  const double a = sun.at("azimuth_deg").get<double>() * M_PI / 180.0;
  const double z = (90.0 - sun.at("elevation_refracted_deg").get<double>()) * M_PI / 180.0;
  const double x = 500.0 + 400.0 * std::tan(z / 2) * std::sin(a);
  const double y = 550.0 - 400.0 * std::tan(z / 2) * std::cos(a);
  const cv::Vec3b inside = png.at<cv::Vec3b>(static_cast<int>(y), static_cast<int>(x));
  EXPECT_EQ(inside, cv::Vec3b(0, 190, 250));  // Blue, green, red.
  double sum_x = 0.0, sum_y = 0.0;
  int count = 0;
  for (int row = 0; row < png.rows; ++row) {
    for (int column = 0; column < png.cols; ++column) {
      if (png.at<cv::Vec3b>(row, column) != inside) continue;
      sum_x += column + 0.5;
      sum_y += row + 0.5;
      ++count;
    }
  }
  EXPECT_NEAR(count, M_PI * 8.5 * 8.5, 40.0);
  EXPECT_NEAR(sum_x / count, x, 0.6);
  EXPECT_NEAR(sum_y / count, y, 0.6);
}

TEST(Sun, HasAHelpWithExamples) {
  const RunResult run = RunPleinair({"sun", "--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("Examples:"), HasSubstr("--utc-offset"), HasSubstr("--path")));
}

class SunRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(SunRefusal, IsOneLineAndLeavesNothing) { ExpectRefusal("sun", GetParam()); }

const std::string kNoon = "2025-09-14T11:05:00Z";

INSTANTIATE_TEST_SUITE_P(
    BadInput, SunRefusal,
    ::testing::Values(
        Refusal{"Nothing", {}, "needs a place and a time"},
        Refusal{"Latitude", {"--at", "90.5,14", "--time", kNoon}, "lat \"90.5\""},
        Refusal{"Longitude", {"--at", "50,400", "--time", kNoon}, "lon \"400\""},
        Refusal{"NoPlace", {"--at", "Prague", "--time", kNoon}, "is not a place"},
        Refusal{"NanPlace", {"--at", "nan,14", "--time", kNoon}, "lat \"nan\""},
        Refusal{"ImpossibleDate",
                {"--at", "50,14", "--time", "2025-02-29T00:00:00Z", "-o", "OUT/a"},
                "names a day that does not exist"},
        Refusal{"ImpossibleHour", {"--at", "50,14", "--time", "2025-02-28T24:00:00Z"}, "hour"},
        Refusal{"NoOffset", {"--at", "50,14", "--time", "2025-02-28T12:00:00"}, "offset"},
        Refusal{"ImpossibleDay",
                {"--at", "50,14", "--day", "2025-06-31", "--utc-offset", "+1", "-o", "OUT/a"},
                "--day: \"2025-06-31\" is not a day"},
        Refusal{"ImpossibleDayWithoutClock",
                {"--at", "50,14", "--day", "2025-02-30"},
                "--day: \"2025-02-30\" is not a day"},
        Refusal{"ImpossibleDayWithoutZone",
                {"--at", "50,14", "--time", "2025-02-30T12:00:00"},
                "names a day that does not exist"},
        Refusal{"ClockOfASpan",
                {"--at", "50,14", "--from", kNoon, "--to", "2025-09-15T00:00:00Z", "--utc-offset",
                 "+02:00"},
                "--utc-offset: has no effect here"},
        Refusal{"DayWithoutClock", {"--at", "50,14", "--day", "2025-06-30"}, "--utc-offset"},
        Refusal{"BadOffset",
                {"--at", "50,14", "--day", "2025-06-30", "--utc-offset", "+25:00"},
                "is not an offset from UTC"},
        Refusal{"WordForOffset",
                {"--at", "50,14", "--day", "2025-06-30", "--utc-offset", "CEST"},
                "is not an offset from UTC"},
        Refusal{"NoClock",
                {"--at", "50,14", "--time", kNoon, "--utc-offset", ""},
                "--utc-offset: is given without a value"},
        Refusal{"NoDays",
                {"--at", "50,14", "--day", "2025-06-30", "--utc-offset", "Z", "--days", "0"},
                "--days"},
        Refusal{"UnknownModel", {"--at", "50,14", "--time", kNoon, "--model", "rough"}, "rough"},
        Refusal{"BackwardSpan",
                {"--at", "50,14", "--from", kNoon, "--to", "2025-09-13T00:00:00Z", "-o", "OUT/a"},
                "lies before"},
        Refusal{"NoStep",
                {"--at", "50,14", "--from", kNoon, "--to", kNoon, "--step", "0", "-o", "OUT/a"},
                "--step"},
        Refusal{"PathOfUnknownKind",
                {"--at", "50,14", "--path", "OUT/a.gif", "--year", "2025"},
                "neither SVG nor PNG"},
        Refusal{"PathWithoutYear", {"--at", "50,14", "--path", "OUT/a.svg"}, "--year"},
        Refusal{"PathInYearZero", {"--at", "50,14", "--path", "OUT/a.svg", "--year", "0"}, "year"},
        Refusal{"PathIntoNoFolder",
                {"--at", "50,14", "--path", "OUT/none/a.png", "--year", "2025"},
                "cannot write"},
        Refusal{"NoSuchTable", {"--csv", "OUT/none.csv"}, "none.csv: there is no such file"}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

TEST(Sun, NamesTheLineOfABrokenTableAndWritesNothing) {
  for (const std::string broken :
       {"2025-01-01T00:00:00Z,91,2\n", "2025-01-01T00:00:00Z,1\n", "2025-13-01T00:00:00Z,1,2\n",
        "2025-01-01T00:00:00Z,one,2\n", "2025-01-01T00:00:00Z,\"1,2\n", "\n"}) {
    ExpectBrokenLineIsNamed({"sun"}, "utc,lat,lon\n2025-01-01T00:00:00Z,1,2\n", broken,
                            "2025-01-01T00:00:00Z,3,4\n");
  }
}

TEST(Sun, LeavesAnEarlierFileAloneWhenItFails) {
  const TemporaryFolder folder;
  WriteFile(folder / "in.csv", "utc,lat,lon\nnever,1,2\n");
  WriteFile(folder / "out.csv", "what was there");
  EXPECT_EQ(RunPleinair({"sun", "--csv", folder / "in.csv", "-o", folder / "out.csv"}).exit_code,
            2);
  EXPECT_EQ(ReadFile(folder / "out.csv"), "what was there");
}

TEST(Sun, ReportsAFullDisk) {
  const TemporaryFolder folder;
  const RunResult run =
      RunPleinair({"sun", "--at", "50,14", "--from", "2025-01-01T00:00:00Z", "--to",
                   "2025-01-03T00:00:00Z", "--step", "60", "-o", folder / "out.csv"},
                  "ulimit -f 16;");
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_THAT(run.err, HasSubstr("File too large"));
  EXPECT_THAT(Listing(folder.path()), IsEmpty());
  EXPECT_THAT(run.err, Not(HasSubstr("unexpected")));
}

}  // namespace
}  // namespace pleinair::e2e
