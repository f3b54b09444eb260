// Tests `pleinair detect --family sg` as a process, on markers from `pleinair marker`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/srgb.h"
#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr double kFocal_px = 800.0, kSize_mm = 140.0;
constexpr double kLensBlur_px = 0.6;
constexpr int kPrint_px = 240, kEdge_px = 200, kQuiet_px = 20;
const cv::Size kPicture(400, 300);

class SgDetect : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteFile(folder_ / "camera.yaml",
              "%YAML:1.0\n---\nimage_width: 400\nimage_height: 300\n"
              "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
              "   data: [ 800., 0., 199.5, 0., 800., 149.5, 0., 0., 1. ]\n"
              "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
              "   data: [ 0., 0., 0., 0., 0. ]\n");
    const RunResult run = RunPleinair(
        {"marker", "17", "--png", "--pixels", std::to_string(kPrint_px), "-o", folder_ / "m.png"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    print_ = cv::imread(folder_ / "m.png", cv::IMREAD_GRAYSCALE);
    ASSERT_EQ(print_.size(), cv::Size(kPrint_px, kPrint_px));
    // Ink and paper within the camera's range, in place of pure black and white.
    print_ = print_ * 0.7 + 30;
  }

  static cv::Mat Grey() { return {kPicture, CV_8UC1, cv::Scalar(120)}; }

  /// An image of the marker with its top-left pixel at `at`.
  cv::Mat With(cv::Point at) const {
    cv::Mat picture = Grey();
    print_.copyTo(picture(cv::Rect(at, print_.size())));
    return picture;
  }

  /// The image through a lens: real edges are less sharp than drawn ones. The blur acts on linear
  /// light, not on pixel values.
  static cv::Mat Seen(const cv::Mat& picture) {
    cv::Mat light(picture.size(), CV_32FC1), seen(picture.size(), CV_8UC1);
    std::ranges::transform(cv::Mat1b(picture), cv::Mat1f(light).begin(),
                           [](std::uint8_t code) { return LinearFromSrgb8()[code]; });
    cv::GaussianBlur(light, light, {}, kLensBlur_px);
    std::ranges::transform(cv::Mat1f(light), cv::Mat1b(seen).begin(), Srgb8FromLinear);
    return seen;
  }

  std::string Save(const std::string& name, const cv::Mat& picture) const {
    EXPECT_TRUE(cv::imwrite(folder_ / name, Seen(picture)));
    return folder_ / name;
  }

  RunResult Detect(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "detect");
    arguments.insert(arguments.end(), {"--family", "sg", "--size-mm", "140", "--calibration",
                                       folder_ / "camera.yaml"});
    return RunPleinair(arguments);
  }

  const TemporaryFolder folder_;
  cv::Mat print_;
};

TEST_F(SgDetect, ReportsNumberCornersPoseAndVisibilityOfAPrintedMarker) {
  const std::string picture = Save("whole.png", With({70, 40}));
  const RunResult run = Detect({picture});
  EXPECT_THAT(run.err, IsEmpty());
  const auto lines = JsonLines(run);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].at("file"), picture);
  EXPECT_GT(lines[0].at("milliseconds").get<double>(), 0.0);
  EXPECT_FALSE(lines[0].contains("lost"));  // Not reported without tracking.
  ASSERT_EQ(lines[0].at("markers").size(), 1U);
  const json& marker = lines[0]["markers"][0];
  EXPECT_EQ(marker.at("family"), "sg");
  EXPECT_EQ(marker.at("id"), 17);
  EXPECT_EQ(marker.at("path"), "fast");
  EXPECT_GT(marker.at("visible_fraction").get<double>(), 0.9);
  // The edges of pixels are half a pixel before their centres.
  const double left = 70 + kQuiet_px - 0.5, top = 40 + kQuiet_px - 0.5;
  const double corners[4][2] = {{left, top},
                                {left + kEdge_px, top},
                                {left + kEdge_px, top + kEdge_px},
                                {left, top + kEdge_px}};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(marker.at("corners")[i][0].get<double>(), corners[i][0], 0.05);
    EXPECT_NEAR(marker.at("corners")[i][1].get<double>(), corners[i][1], 0.05);
  }
  const auto translation = marker.at("camera_from_marker").at("translation_m");
  const double distance_m = kFocal_px * kSize_mm * 1e-3 / kEdge_px;
  EXPECT_NEAR(translation[0].get<double>(), (left + 100 - 199.5) / kFocal_px * distance_m, 5e-4);
  EXPECT_NEAR(translation[1].get<double>(), (top + 100 - 149.5) / kFocal_px * distance_m, 5e-4);
  EXPECT_NEAR(translation[2].get<double>(), distance_m, 2e-3);
  // Upright and from the front: x right, y up in the image, z towards the camera.
  const double upright[9] = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(marker["camera_from_marker"].at("rotation")[i].get<double>(), upright[i], 0.03);
  }
  EXPECT_EQ(marker.at("covariance").size(), 36U);
  EXPECT_TRUE(marker.contains("alternative"));
  const json& visibility = marker.at("visibility");
  const int side = visibility.at("side").get<int>();
  ASSERT_GE(side, 4);
  ASSERT_EQ(visibility.at("values").size(), static_cast<std::size_t>(side) * side);
  for (const json& value : visibility["values"]) EXPECT_GT(value.get<double>(), 0.7);
}

TEST_F(SgDetect, FindsACoveredBorderByItsKeypointsUnlessToldToBeFast) {
  cv::Mat covered = With({70, 40});
  covered(cv::Rect(60, 30, 65, 260)).setTo(150);  // The left side with its rim.
  const std::string picture = Save("covered.png", covered);
  for (const char* strategy : {"hybrid", "surf-golay"}) {
    const auto markers = JsonLines(Detect({picture, "--strategy", strategy})).at(0).at("markers");
    ASSERT_EQ(markers.size(), 1U) << strategy;
    EXPECT_EQ(markers[0]["id"], 17);
    EXPECT_EQ(markers[0]["path"], "surf-golay");
    EXPECT_NEAR(markers[0]["corners"][2][0].get<double>(), 70 + kPrint_px - kQuiet_px - 0.5, 0.3);
    const json& visibility = markers[0]["visibility"];
    const int side = visibility["side"].get<int>();
    for (int row = 0; row < side; ++row) {
      EXPECT_LT(visibility["values"][row * side].get<double>(), 0.3) << "left end of row " << row;
      EXPECT_GT(visibility["values"][(row + 1) * side - 1].get<double>(), 0.7) << "right end";
    }
  }
  EXPECT_THAT(JsonLines(Detect({picture, "--strategy", "fast"})).at(0).at("markers"), IsEmpty());
}

TEST_F(SgDetect, ReportsOnlyNumbersInUse) {
  const std::string picture = Save("whole.png", With({70, 40}));
  for (const char* numbers : {"17", "0-49", "1,2,17", "17-17"}) {
    const auto markers = JsonLines(Detect({picture, "--numbers", numbers})).at(0).at("markers");
    ASSERT_EQ(markers.size(), 1U) << numbers;
    EXPECT_EQ(markers[0]["id"], 17);
  }
  for (const char* numbers : {"0-16", "18", "1000-2000"}) {
    EXPECT_THAT(JsonLines(Detect({picture, "--numbers", numbers})).at(0).at("markers"), IsEmpty())
        << numbers;
  }
}

TEST_F(SgDetect, FollowsAMarkerAndSaysSinceWhenItIsLost) {
  const auto lines = JsonLines(
      Detect({Save("0.png", With({70, 40})), Save("1.png", With({72, 41})), Save("2.png", Grey()),
              Save("3.png", Grey()), Save("4.png", With({110, 45})), "--track"}));
  ASSERT_EQ(lines.size(), 5U);
  const std::vector<std::string> paths{"fast", "tracked", "", "", "fast"};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    SCOPED_TRACE("picture " + std::to_string(i));
    const json& markers = lines[i].at("markers");
    const json& lost = lines[i].at("lost");
    if (!paths[i].empty()) {
      ASSERT_EQ(markers.size(), 1U);
      EXPECT_EQ(markers[0]["id"], 17);
      EXPECT_EQ(markers[0]["path"], paths[i]);
      EXPECT_THAT(lost, IsEmpty());
      continue;
    }
    EXPECT_THAT(markers, IsEmpty());
    EXPECT_EQ(lost, json::parse(R"([{"family": "sg", "id": 17, "frames": )" +
                                std::to_string(i - 1) + "}]"));
  }
}

TEST_F(SgDetect, ReportsAMarkerWhoseNumberIsCoveredWithoutOne) {
  cv::Mat picture = With({70, 40});
  // The middle half of the sheet holds all cells.
  const cv::Rect sheet(70, 40, print_.cols, print_.rows);
  const cv::Rect cells(sheet.x + sheet.width * 7 / 24, sheet.y + sheet.height * 7 / 24,
                       sheet.width * 10 / 24, sheet.height * 10 / 24);
  picture(cells) = cv::Scalar(120);
  const nlohmann::json markers = JsonLines(Detect({Save("held.png", picture)})).at(0).at("markers");
  ASSERT_EQ(markers.size(), 1U);
  EXPECT_TRUE(markers[0].at("id").is_null());
  EXPECT_EQ(markers[0].at("camera_from_marker").at("translation_m").size(), 3U);
}

TEST_F(SgDetect, RefusesImagesThatNeedGigabytes) {
  // A header of 16384x16384 and no pixels: they are not read.
  const std::string png(
      "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x40\0\0\0\x40\0\x08\x02\0\0\0\x26\xaa\x87\xd3"
      "\0\0\0\0IEND\xae\x42\x60\x82",
      45);
  WriteFile(folder_ / "large.png", png);
  ExpectRefused(Detect({folder_ / "large.png"}), "large.png: has 268 megapixels");
}

TEST_F(SgDetect, WarnsOfAMirroredMarker) {
  cv::Mat mirrored;
  cv::flip(With({70, 40}), mirrored, 1);
  const RunResult run = Detect({Save("mirrored.png", mirrored)});
  EXPECT_THAT(JsonLines(run).at(0).at("markers"), IsEmpty());
  EXPECT_THAT(run.err, AllOf(HasSubstr("mirrored.png"), HasSubstr("mirrored"), HasSubstr("17")));
}

TEST_F(SgDetect, RefusesOptionsOfSgMarkersWhereNoneAreLookedFor) {
  const std::string picture = Save("whole.png", With({70, 40}));
  for (const auto& [option, value] :
       {std::pair{"--numbers", "17"}, std::pair{"--strategy", "fast"}}) {
    const RunResult run =
        RunPleinair({"detect", picture, "--family", "tag36h11", "--size-mm", "140", "--calibration",
                     folder_ / "camera.yaml", option, value});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, AllOf(HasSubstr(option), HasSubstr("has no effect here")));
    EXPECT_THAT(run.out, IsEmpty());
  }
}

TEST_F(SgDetect, RefusesStrategiesAndNumbersThatDoNotExist) {
  const std::string picture = Save("whole.png", With({70, 40}));
  struct Bad {
    std::string argument, message;
  };
  for (const auto& [argument, message] :
       {Bad{"--strategy=quick", "hybrid, fast or surf-golay"}, Bad{"--strategy=", "--strategy"},
        Bad{"--numbers=4096", "4096"}, Bad{"--numbers=-3", "-3"}, Bad{"--numbers=9-5", "9-5"},
        Bad{"--numbers=5-", "5-"}, Bad{"--numbers=0-4096", "0-4095"}, Bad{"--numbers=x", "\"x\""},
        Bad{"--numbers=3,4 5", "4 5"}, Bad{"--numbers=99999999999", "99999999999"}}) {
    SCOPED_TRACE(argument);
    const RunResult run = Detect({picture, argument});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, AllOf(StartsWith("pleinair: "), HasSubstr(message)));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.out, IsEmpty());
  }
}

}  // namespace
}  // namespace pleinair::e2e
