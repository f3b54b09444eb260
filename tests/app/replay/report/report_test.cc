#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "app/replay/replay_warnings.h"
#include "app/replay/report/report_html.h"
#include "app/replay/report/report_json.h"
#include "export/plots/line_plot.h"
#include "files/base64.h"

namespace pleinair::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

session::Observation At(std::int64_t frame, double x_m) {
  session::Observation at;
  at.frame_index = frame;
  at.timestamp_ns = frame * 100'000'000;
  at.camera_from_marker.translation_m = {x_m, 0, 2};
  at.reprojection_rms_px = 0.1;
  return at;
}

ReplayReport Example() {
  ReplayReport report;
  report.call.recording = "<b>site & \"garden\"</b>";
  report.call.command = "pleinair replay 'x'";
  report.film.frames = 3;
  report.reference_marker = session::MarkerName{"tag36h11", 7};
  report.path = {At(0, 0.0), At(1, 0.1), At(2, 0.2)};
  report.warnings = {"<script>alert(1)</script>"};
  report.timings = {{"track", 3, 1.5, 2.5, 6.0}, {kWholeReplay, 1, 1500.0, 1500.0, 1500.0}};
  report.files.pictures = {{1, {1, 2, 3}, {4, 5, 6}}};
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
    return files::Base64(std::vector<std::uint8_t>(text.begin(), text.end()));
  };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

TEST(ReportJson, StatesTheSamplesThatTheRendererGave) {
  ReplayReport report = Example();
  const auto samples = [&] {
    return nlohmann::json::parse(ReportJson(report))["antialiasing"]["samples"];
  };
  EXPECT_EQ(samples(), nullptr) << "nothing is drawn";
  report.film.samples = 2;
  report.film.antialiasing.method = compositor::AntialiasingMethod::kMultisample;
  EXPECT_EQ(samples(), 2);
  report.film.antialiasing.method = compositor::AntialiasingMethod::kNone;
  EXPECT_EQ(samples(), 1);
  report.film.antialiasing.method = compositor::AntialiasingMethod::kReference;
  report.film.antialiasing.places = 16;
  EXPECT_EQ(samples(), 16);
  report.film.antialiasing.method = compositor::AntialiasingMethod::kSubpixel;
  EXPECT_EQ(samples(), 16);
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
  report.film.frames = 9;
  report.path = {At(1, 0.0), At(2, 0.1), At(4, 0.2)};
  report.path[1].path = tracker::DetectionPath::kTracked;
  report.path[2].path = tracker::DetectionPath::kSurfGolay;
  report.path[2].visible_fraction = 0.4;
  const auto poses = nlohmann::json::parse(ReportJson(report))["poses"];
  EXPECT_EQ(poses["found_by"], nlohmann::json::parse(R"({"fast":1,"surf-golay":1,"tracked":1})"));
  EXPECT_EQ(poses["visible_fraction"]["min"], 0.4);
  EXPECT_EQ(poses["visible_fraction"]["median"], 1.0);
  // Frame 3 and frames 5 to 8. Before frame 1 there was no track to lose.
  EXPECT_EQ(poses["lost"], nlohmann::json::parse(R"({"frames":5,"longest":4})"));
  EXPECT_THAT(ReportHtml(report), HasSubstr("frames in which it was lost (longest: 4)"));
  // One frame of a recording, counted by its index in the whole.
  report.film.first_frame = 45;
  report.film.frames = 1;
  report.path = {At(45, 0.0)};
  EXPECT_EQ(nlohmann::json::parse(ReportJson(report))["poses"]["lost"],
            nlohmann::json::parse(R"({"frames":0,"longest":0})"));
}

TEST(ReportJson, SurvivesNamesThatAreNotUtf8) {
  ReplayReport report = Example();
  report.call.recording = "caf\xe9";
  EXPECT_TRUE(nlohmann::json::accept(ReportJson(report)));
}

using Source = compositor::MeasuredLight::Source;

/// A sun, a heading and an exposure scale estimated from frames.
session::LightSummary MeasuredSummary() {
  session::LightSummary light;
  light.sun.azimuth = FromDegrees(151.2);
  light.sun.elevation = FromDegrees(41.5);
  light.sun.elevation_refracted = FromDegrees(41.6);
  light.sun_normal_lux = 92300.0;
  light.sky_horizontal_lux = 12700.0;
  light.exposure_scale = {3e-5, 2.5e-5, 2e-5};
  light.exposure_scale_error = {0.011, 0.022, 0.033};
  light.exposures.change = 1.25;
  light.exposures.estimates = 40;
  light.exposures.dappled = 10;
  light.exposures.sunlit_share = 0.625;
  light.measured.sun_source = light.measured.heading_source = Source::kMeasured;
  light.measured.sun_to_sky = 4.55;
  light.measured.sun_to_sky_stated = 4.74;
  light.measured.sun_to_sky_error = 0.07;
  light.measured.heading_offset = FromDegrees(-1.5);
  light.measured.heading_error = FromDegrees(0.25);
  light.measured.evidence.frames = 8;
  light.measured.evidence.edges = 45;
  light.measured.evidence.edges_agreeing = 31;
  light.measured.evidence.edges_with_contrast = 0.84;
  return light;
}

nlohmann::json JsonOf(const session::LightSummary& light) {
  ReplayReport report = Example();
  report.light = light;
  return nlohmann::json::parse(ReportJson(report))["light"];
}

std::string PageOf(const session::LightSummary& light) {
  ReplayReport report = Example();
  report.light = light;
  return ReportHtml(report);
}

TEST(ReportLight, StatesWhatWasMeasuredAndHowCertainItIs) {
  const nlohmann::json json = JsonOf(MeasuredSummary());
  EXPECT_EQ(json["sun_azimuth_deg"], 151.2);
  EXPECT_EQ(json["sun_normal_lux"], 92300.0);
  EXPECT_EQ(json["sky_horizontal_lux"], 12700.0);
  EXPECT_EQ(json["gain_rgb"], (nlohmann::json{3e-5, 2.5e-5, 2e-5}));
  EXPECT_EQ(json["gain_from"], "marker");
  EXPECT_EQ(json["gain_relative_error_rgb"], (nlohmann::json{0.011, 0.022, 0.033}));
  EXPECT_EQ(json["gain_change"], 1.25);
  EXPECT_EQ(json["gain_readings"], 40);
  EXPECT_EQ(json["marker_in_sun"], 0.625);
  EXPECT_EQ(json["marker_dappled"], 0.25);
  const nlohmann::json& measured = json["measured"];
  EXPECT_EQ(measured["sun_to_sky"], 4.55);
  EXPECT_EQ(measured["sun_to_sky_relative_error"], 0.07);
  EXPECT_EQ(measured["sun_from"], "measured");
  EXPECT_EQ(measured["heading_offset_deg"], -1.5);
  EXPECT_EQ(measured["heading_error_deg"], 0.25);
  EXPECT_EQ(measured["shadow_edges_agreeing"], 31);
  EXPECT_EQ(measured["shadow_edges_with_contrast"], 0.84);
  EXPECT_EQ(measured["sun_doubtful"], false);

  const std::string page = PageOf(MeasuredSummary());
  EXPECT_THAT(page, HasSubstr("<b>151.2° / 41.6°</b><span>sun: azimuth"));
  EXPECT_THAT(page, HasSubstr("<b>92.3 klx</b>"));
  EXPECT_THAT(page, HasSubstr("<b>12.7 klx</b>"));
  EXPECT_THAT(page, HasSubstr("<b>4.55</b><span>sun-to-sky ratio on level ground, ± 7 %: 31 of 45 "
                              "shadow edges agree, in 8 frames; scene: 4.74"));
  EXPECT_THAT(page, HasSubstr("<b>84 %</b><span>of 45 phantom shadow edges"));
  EXPECT_THAT(page, HasSubstr("<b>-1.50° ± 0.25°</b>"));
  EXPECT_THAT(page, HasSubstr("<b>62 % in the sun</b>"));
  EXPECT_THAT(page, HasSubstr("foliage shades it in 25 % of frames"));
  EXPECT_THAT(page, HasSubstr("<b>3e-05 2.5e-05 2e-05</b>"));
  EXPECT_THAT(page, HasSubstr("± 1.1 2.2 3.3 % from the marker in 40 frames, changed by a factor "
                              "of 1.25"));
  EXPECT_THAT(page, Not(HasSubstr("doubtful")));
}

TEST(ReportLight, StatesTheRatioThatTreesShadeTells) {
  session::LightSummary light = MeasuredSummary();
  light.measured.sun_source = Source::kShade;
  light.measured.evidence.shade_places = 12;
  light.measured.sun_to_sky_error = 0.21;
  const nlohmann::json measured = JsonOf(light)["measured"];
  EXPECT_EQ(measured["sun_from"], "shade");
  EXPECT_EQ(measured["shade_places"], 12);
  EXPECT_EQ(measured["sun_to_sky_relative_error"], 0.21);
  EXPECT_THAT(PageOf(light), HasSubstr("± 21 %, from the contrast of tree shadows at 12 places"));
}

TEST(ReportLight, StatesTheRatioThatAShadowAcrossTheMarkerTells) {
  session::LightSummary light = MeasuredSummary();
  light.measured.sun_source = Source::kMarker;
  light.measured.sun_to_sky_error = 0.15;
  EXPECT_EQ(JsonOf(light)["measured"]["sun_from"], "marker");
  EXPECT_THAT(PageOf(light), HasSubstr("± 15 %, from a shadow edge on the marker"));
}

TEST(ReportLight, ClaimsNoCertaintyOfWhatIsOnlySaid) {
  session::LightSummary light = MeasuredSummary();
  light.measured = {};
  light.measured.sun_to_sky = 4.74;
  const nlohmann::json stated = JsonOf(light)["measured"];
  for (const char* key :
       {"sun_to_sky_relative_error", "heading_error_deg", "shadow_edges_with_contrast"}) {
    ASSERT_TRUE(stated.contains(key)) << key;
    EXPECT_TRUE(stated[key].is_null()) << key;
  }
  EXPECT_EQ(stated["sun_from"], "stated");
  EXPECT_THAT(PageOf(light),
              HasSubstr("<b>4.74</b><span>sun-to-sky ratio on level ground, from the scene"));
  EXPECT_THAT(PageOf(light), Not(HasSubstr("phantom shadow edges")));
  light.measured.sun_source = light.measured.heading_source = Source::kOverride;
  const nlohmann::json given = JsonOf(light)["measured"];
  EXPECT_EQ(given["sun_from"], "option");
  EXPECT_TRUE(given["sun_to_sky_relative_error"].is_null());
  EXPECT_TRUE(given["heading_error_deg"].is_null());
  EXPECT_THAT(PageOf(light), HasSubstr("sun-to-sky ratio on level ground, from --sun-to-sky"));
}

TEST(ReportLight, ReportsWhoGaveTheExposure) {
  session::LightSummary light = MeasuredSummary();
  light.exposures.estimates = light.exposures.dappled = 0;
  for (const auto& [source, name, words] :
       {std::tuple{session::LightSummary::ExposureScaleSource::kScene, "scene", "from the scene"},
        std::tuple{session::LightSummary::ExposureScaleSource::kGuess, "guess", "guessed"}}) {
    light.exposure_scale_source = source;
    const nlohmann::json json = JsonOf(light);
    EXPECT_EQ(json["gain_from"], name);
    for (const char* key :
         {"gain_relative_error_rgb", "gain_change", "marker_in_sun", "marker_dappled"}) {
      ASSERT_TRUE(json.contains(key)) << key;
      EXPECT_TRUE(json[key].is_null()) << key << " of " << name;
    }
    const std::string page = PageOf(light);
    EXPECT_THAT(page,
                HasSubstr(std::string("camera exposure scale (r g b per cd/m²), ") + words + "<"));
    EXPECT_THAT(page, Not(HasSubstr("from the marker in")));
    EXPECT_THAT(page, Not(HasSubstr("marker, by the phantoms")));
  }
}

TEST(ReportLight, ReportsTheColorsOfDescribedSurfaces) {
  using Outcome = compositor::SurfaceColor::Outcome;
  session::LightSummary light = MeasuredSummary();
  light.surface_colors.push_back(
      {"ground", {0.4, 0.36, 0.3}, {Outcome::kMeasured, {0.4, 0.36, 0.3}, 0.11, 200}});
  light.surface_colors.push_back({"wall 1", {0.35, 0.33, 0.3}, {Outcome::kUneven, {}, 0.0, 0}});
  const auto colors = JsonOf(light)["surface_colors"];
  ASSERT_EQ(colors.size(), 2U);
  EXPECT_EQ(colors[0]["outcome"], "measured");
  EXPECT_EQ(colors[0]["reflectance_rgb"][0], 0.4);
  EXPECT_EQ(colors[0]["relative_error"], 0.11);
  EXPECT_EQ(colors[1]["outcome"], "uneven");
  EXPECT_TRUE(colors[1]["relative_error"].is_null());
  const std::vector<std::string> warnings = LightWarnings(light, {});
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [](const std::string& sentence) {
                            return sentence.find("The color of wall 1") == 0;
                          }),
            1);
}

TEST(ReportLight, ReportsWhetherTheMarkerLiesInTheSun) {
  session::LightSummary light = MeasuredSummary();
  light.exposures.sunlit_share = 1.0;
  EXPECT_THAT(PageOf(light), HasSubstr("<b>in the sun</b>"));
  light.exposures.sunlit_share = 0.0;
  EXPECT_EQ(JsonOf(light)["marker_in_sun"], 0.0);
  EXPECT_THAT(PageOf(light), HasSubstr("<b>in shade</b>"));
  light.measured.sun_shines = false;
  EXPECT_TRUE(JsonOf(light)["marker_in_sun"].is_null());
  EXPECT_THAT(PageOf(light), HasSubstr("<b>no sun</b><span>marker"));
}

TEST(ReportLight, ReportsThatTheSunIsDoubtful) {
  session::LightSummary light = MeasuredSummary();
  light.measured.sun_source = Source::kDescription;
  light.measured.sun_to_sky_error.reset();
  light.measured.sun_doubtful = true;
  light.measured.evidence.edges_with_contrast = -0.04;
  EXPECT_EQ(JsonOf(light)["measured"]["sun_doubtful"], true);
  EXPECT_EQ(JsonOf(light)["measured"]["shadow_edges_with_contrast"], -0.04);
  EXPECT_THAT(PageOf(light), HasSubstr("<b>doubtful</b><span>whether the sun shone"));
  EXPECT_THAT(PageOf(light), HasSubstr("<b>0 %</b><span>of 45 phantom shadow edges"));
}

TEST(ReportLight, ReportsThatNoSunShone) {
  session::LightSummary light = MeasuredSummary();
  light.measured.sun_shines = false;
  light.measured.sun_to_sky = 0.0;
  light.measured.sun_to_sky_error.reset();
  EXPECT_TRUE(JsonOf(light)["measured"]["sun_to_sky_relative_error"].is_null());
  EXPECT_THAT(PageOf(light), HasSubstr("<b>no sun</b><span>where phantoms would cast shadows: 31 "
                                       "of 45 shadow edges agree"));
}

TEST(SummarizeTrajectory, DoesNotCountStepsAcrossFramesWithoutAPose) {
  const PoseStatistics statistics = SummarizeTrajectory({At(0, 0.0), At(1, 0.1), At(5, 3.0)});
  EXPECT_NEAR(statistics.path_length_m, 0.1, 1e-12);
  EXPECT_NEAR(statistics.distance_max_m, std::sqrt(13.0), 1e-12);
}

TEST(SummarizeTrajectory, CountsPosesThatMayBeTheOtherPlanarSolution) {
  std::vector<session::Observation> path = {At(0, 0.0), At(1, 0.1), At(2, 0.2), At(3, 0.3)};
  path[1].ambiguity_ratio = 0.0005;  // Certain: below 0.001.
  path[2].ambiguity_ratio = 0.01;
  path[3].ambiguity_ratio = 0.9;
  EXPECT_EQ(SummarizeTrajectory(path).ambiguous_frames, 2);
}

TEST(LinePlot, LeavesAGapWhereAPointIsMissing) {
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = exports::LinePlotSvg("t", "m", {{"", {0, 1, 2, 3}, {1, gap, 2, 3}}});
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  const std::size_t path = svg.find("<path");
  ASSERT_NE(path, std::string::npos);
  EXPECT_EQ(std::count(svg.begin() + path, svg.end(), 'M'), 2);
}

TEST(LinePlot, DrawsConstantsAndNothingAtAll) {
  EXPECT_THAT(exports::LinePlotSvg("t", "m", {{"", {0, 1}, {5, 5}}}), Not(HasSubstr("nan")));
  EXPECT_THAT(exports::LinePlotSvg("t", "m", {{"", {}, {}}}), Not(HasSubstr("inf")));
}

TEST(TickStep, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(exports::TickStep(0, 10, 4), 5);
  EXPECT_DOUBLE_EQ(exports::TickStep(0, 0.37, 4), 0.1);
  EXPECT_DOUBLE_EQ(exports::TickStep(-90, 90, 4), 50);
}

}  // namespace
}  // namespace pleinair::app
