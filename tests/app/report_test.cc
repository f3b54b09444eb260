#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/base64.h"
#include "app/sinks/line_plot.h"
#include "app/sinks/report_html.h"
#include "app/sinks/report_json.h"

namespace pleinair::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Observation At(std::int64_t frame, double x_m) {
  Observation at;
  at.frame_index = frame;
  at.timestamp_ns = frame * 100'000'000;
  at.camera_from_marker.translation_m = {x_m, 0, 2};
  at.reprojection_rms_px = 0.1;
  return at;
}

ReplayReport Example() {
  ReplayReport report;
  report.recording = "<b>site & \"garden\"</b>";
  report.command = "pleinair replay 'x'";
  report.frames = 3;
  report.anchor = MarkerName{"tag36h11", 7};
  report.path = {At(0, 0.0), At(1, 0.1), At(2, 0.2)};
  report.warnings = {"<script>alert(1)</script>"};
  report.timings = {{"track", 3, 1.5, 2.5, 6.0}, {kWholeReplay, 1, 1500.0, 1500.0, 1500.0}};
  report.pictures = {{1, {1, 2, 3}, {4, 5, 6}}};
  return report;
}

TEST(ReportHtml, EscapesWhateverComesFromOutside) {
  const std::string page = ReportHtml(Example());
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;site &amp; &quot;garden&quot;&lt;/b&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<b>site")));
}

TEST(ReportHtml, NeedsNoOtherFileOrServer) {
  const std::string page = ReportHtml(Example());
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,AQID"));
  EXPECT_THAT(page, HasSubstr("<svg"));
}

TEST(Base64, GivesTheVectorsOfRfc4648) {
  const auto encode = [](const std::string& text) {
    return Base64(std::vector<std::uint8_t>(text.begin(), text.end()));
  };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

TEST(ReportJson, StatesThePathAndTheTimings) {
  const auto json = nlohmann::json::parse(ReportJson(Example()));
  EXPECT_EQ(json["frames_with_pose"], 3);
  EXPECT_EQ(json["marker"], "tag36h11_7");
  EXPECT_NEAR(json["poses"]["path_length_m"], 0.2, 1e-9);
  EXPECT_EQ(json["timings"][0]["p95_ms"], 2.5);
  EXPECT_EQ(json["timings"][0]["frames_per_s"], 500.0) << "3 frames in 6 ms";
  EXPECT_EQ(json["timings"][1]["stage"], "whole replay");
  EXPECT_EQ(json["timings"][1]["frames_per_s"], 2.0);
  EXPECT_TRUE(json["light"].is_null());
}

TEST(ReportJson, StatesHowTheMarkerWasFoundAndWhenItWasLost) {
  ReplayReport report = Example();
  report.frames = 9;
  report.path = {At(1, 0.0), At(2, 0.1), At(4, 0.2)};
  report.path[1].path = tracker::DetectionPath::kTracked;
  report.path[2].path = tracker::DetectionPath::kSurfGolay;
  report.path[2].visible_fraction = 0.4;
  const auto poses = nlohmann::json::parse(ReportJson(report))["poses"];
  EXPECT_EQ(poses["found_by"], nlohmann::json::parse(R"({"fast":1,"surf-golay":1,"tracked":1})"));
  EXPECT_EQ(poses["visible_fraction"]["min"], 0.4);
  EXPECT_EQ(poses["visible_fraction"]["median"], 1.0);
  // Frame 3, and 5 to 8; before frame 1 there was nothing to lose.
  EXPECT_EQ(poses["lost"], nlohmann::json::parse(R"({"frames":5,"longest":4})"));
  EXPECT_THAT(ReportHtml(report), HasSubstr("frames in which it was lost (longest: 4)"));
}

TEST(ReportJson, SurvivesNamesThatAreNotUtf8) {
  ReplayReport report = Example();
  report.recording = "caf\xe9";
  EXPECT_TRUE(nlohmann::json::accept(ReportJson(report)));
}

TEST(SummarizePath, DoesNotCountStepsAcrossFramesWithoutAPose) {
  const PoseStatistics statistics = SummarizePath({At(0, 0.0), At(1, 0.1), At(5, 3.0)});
  EXPECT_NEAR(statistics.path_length_m, 0.1, 1e-12);
  EXPECT_NEAR(statistics.distance_max_m, std::sqrt(13.0), 1e-12);
}

TEST(SummarizePath, CountsPosesThatMayBeTheOtherPlanarSolution) {
  std::vector<Observation> path = {At(0, 0.0), At(1, 0.1), At(2, 0.2), At(3, 0.3)};
  path[1].ambiguity_ratio = 0.0005;  // Certain: below 0.001.
  path[2].ambiguity_ratio = 0.01;
  path[3].ambiguity_ratio = 0.9;
  EXPECT_EQ(SummarizePath(path).ambiguous_frames, 2);
}

TEST(LinePlot, LeavesAGapWhereAPointIsMissing) {
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = LinePlotSvg("t", "m", {{"", {0, 1, 2, 3}, {1, gap, 2, 3}}});
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  const std::size_t path = svg.find("<path");
  ASSERT_NE(path, std::string::npos);
  EXPECT_EQ(std::count(svg.begin() + path, svg.end(), 'M'), 2);
}

TEST(LinePlot, DrawsConstantsAndNothingAtAll) {
  EXPECT_THAT(LinePlotSvg("t", "m", {{"", {0, 1}, {5, 5}}}), Not(HasSubstr("nan")));
  EXPECT_THAT(LinePlotSvg("t", "m", {{"", {}, {}}}), Not(HasSubstr("inf")));
}

TEST(TickStep, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(TickStep(0, 10, 4), 5);
  EXPECT_DOUBLE_EQ(TickStep(0, 0.37, 4), 0.1);
  EXPECT_DOUBLE_EQ(TickStep(-90, 90, 4), 50);
}

}  // namespace
}  // namespace pleinair::app
