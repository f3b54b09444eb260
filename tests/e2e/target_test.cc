// Tests `pleinair target` and `pleinair detect --target` as processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/e2e/command_output.h"
#include "tests/e2e/poster.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kFocal_px = 800.0, kWidth_mm = 420.0;
const cv::Size kPoster(200, 150), kPicture(400, 300);

class Target : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteFile(folder_ / "camera.yaml",
              "%YAML:1.0\n---\nimage_width: 400\nimage_height: 300\n"
              "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
              "   data: [ 800., 0., 199.5, 0., 800., 149.5, 0., 0., 1. ]\n"
              "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
              "   data: [ 0., 0., 0., 0., 0. ]\n");
    poster_ = Poster(1);
    Save("poster.png", poster_);
  }

  std::string Save(const std::string& name, const cv::Mat& picture) const {
    EXPECT_TRUE(cv::imwrite(folder_ / name, picture));
    return folder_ / name;
  }

  /// The poster scaled by a quarter, its top-left pixel at `at`.
  cv::Mat With(cv::Point at, const cv::Mat& poster) const {
    cv::Mat picture(kPicture, CV_8UC1, cv::Scalar(120)), small;
    cv::resize(poster, small, kPoster, 0, 0, cv::INTER_AREA);
    small.copyTo(picture(cv::Rect(at, kPoster)));
    return picture;
  }

  RunResult Make(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"target", folder_ / "poster.png",   "--width-mm", "420",
                                       "-o",     folder_ / "poster.target"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunPleinair(arguments);
  }

  RunResult Detect(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "detect");
    arguments.insert(arguments.end(), {"--target", folder_ / "poster.target", "--calibration",
                                       folder_ / "camera.yaml"});
    return RunPleinair(arguments);
  }

  const TemporaryFolder folder_;
  cv::Mat poster_;
};

TEST_F(Target, IsMadeRatedAndFound) {
  const RunResult made = Make({"--json", "--preview", folder_ / "features.png"});
  EXPECT_THAT(made.err, IsEmpty());
  const auto ratings = JsonLines(made);
  ASSERT_EQ(ratings.size(), 1U);
  EXPECT_EQ(ratings[0].at("name"), "poster");
  EXPECT_EQ(ratings[0].at("file"), (folder_ / "poster.target").string());
  EXPECT_NEAR(ratings[0].at("height_mm").get<double>(), 315.0, 1e-9);
  EXPECT_GT(ratings[0].at("features").get<int>(), 60);
  EXPECT_GE(ratings[0].at("score").get<int>(), 60);
  EXPECT_EQ(ratings[0].at("rating"), "good");
  EXPECT_THAT(Listing(folder_.path()),
              ElementsAre("camera.yaml", "features.png", "poster.png", "poster.target"));
  const cv::Mat features = cv::imread(folder_ / "features.png");
  EXPECT_EQ(features.size(), cv::Size(512, 384));
  cv::Mat green;
  cv::inRange(features, cv::Scalar(60, 230, 0), cv::Scalar(60, 230, 0), green);
  EXPECT_GT(cv::countNonZero(green), 1000);

  const std::string picture = Save("wall.png", With({110, 60}, poster_));
  const RunResult run = Detect({picture});
  EXPECT_THAT(run.err, IsEmpty());
  const auto lines = JsonLines(run);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].at("markers").size(), 1U);
  const json& marker = lines[0]["markers"][0];
  EXPECT_EQ(marker.at("family"), "picture");
  EXPECT_EQ(marker.at("id"), 0);
  EXPECT_EQ(marker.at("name"), "poster");
  EXPECT_EQ(marker.at("path"), "surf-golay");
  EXPECT_GT(marker.at("visible_fraction").get<double>(), 0.95);
  // The edges of pixels are half a pixel before their centres.
  const double left = 109.5, top = 59.5, right = left + 200, bottom = top + 150;
  const double corners[4][2] = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(marker.at("corners")[i][0].get<double>(), corners[i][0], 0.1);
    EXPECT_NEAR(marker.at("corners")[i][1].get<double>(), corners[i][1], 0.1);
  }
  const auto translation = marker.at("camera_from_marker").at("translation_m");
  const double distance_m = kFocal_px * kWidth_mm * 1e-3 / kPoster.width;
  EXPECT_NEAR(translation[0].get<double>(), (left + 100 - 199.5) / kFocal_px * distance_m, 1e-3);
  EXPECT_NEAR(translation[1].get<double>(), (top + 75 - 149.5) / kFocal_px * distance_m, 1e-3);
  EXPECT_NEAR(translation[2].get<double>(), distance_m, 4e-3);
  const double upright[9] = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(marker["camera_from_marker"].at("rotation")[i].get<double>(), upright[i], 0.03);
  }
  EXPECT_EQ(marker.at("covariance").size(), 36U);
  const json& visibility = marker.at("visibility");
  const int side = visibility.at("side").get<int>();
  EXPECT_EQ(visibility.at("values").size(), static_cast<std::size_t>(side) * side);
}

TEST_F(Target, IsFollowedAndSaidToBeLost) {
  ASSERT_EQ(Make({"--name", "Plakát"}).exit_code, 0);
  const auto lines = JsonLines(
      Detect({Save("0.png", With({100, 60}, poster_)), Save("1.png", With({104, 62}, poster_)),
              Save("2.png", With({104, 62}, Poster(7))), Save("3.png", With({150, 90}, poster_)),
              "--track"}));
  ASSERT_EQ(lines.size(), 4U);
  const std::vector<std::string> paths{"surf-golay", "tracked", "", "surf-golay"};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    SCOPED_TRACE("picture " + std::to_string(i));
    if (paths[i].empty()) {
      EXPECT_THAT(lines[i].at("markers"), IsEmpty());
      EXPECT_EQ(lines[i].at("lost"),
                json::parse(R"([{"family": "picture", "id": 0, "name": "Plakát", "frames": 1}])"));
      continue;
    }
    ASSERT_EQ(lines[i].at("markers").size(), 1U);
    EXPECT_EQ(lines[i]["markers"][0]["name"], "Plakát");
    EXPECT_EQ(lines[i]["markers"][0]["path"], paths[i]);
    EXPECT_THAT(lines[i].at("lost"), IsEmpty());
  }
}

TEST_F(Target, ReportsInWordsHowGoodItIs) {
  const RunResult run = Make();
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("\"poster\", 420.0 x 315.0 mm"), HasSubstr("of 100 (good)"),
                             HasSubstr("features over")));
}

TEST_F(Target, WarnsOfAMirroredMarker) {
  ASSERT_EQ(Make().exit_code, 0);
  cv::Mat mirrored;
  cv::flip(With({110, 60}, poster_), mirrored, 1);
  const RunResult run = Detect({Save("mirrored.png", mirrored)});
  EXPECT_THAT(JsonLines(run).at(0).at("markers"), IsEmpty());
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("mirrored.png"), HasSubstr("poster"), HasSubstr("mirrored")));
}

TEST_F(Target, OfABadPictureIsRefusedAndLeavesNothing) {
  Save("even.png", cv::Mat(kPicture, CV_8UC1, cv::Scalar(128)));
  Save("tiny.png", cv::Mat(8, 8, CV_8UC1, cv::Scalar(128)));
  WriteFile(folder_ / "text.png", "no picture");
  const auto before = Listing(folder_.path());
  struct Bad {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::string out = folder_ / "x.target", poster = folder_ / "poster.png";
  for (const auto& [arguments, message] :
       {Bad{{folder_ / "even.png", "--width-mm", "420", "-o", out},
            "even.png: the picture has too few features"},
        Bad{{folder_ / "tiny.png", "--width-mm", "420", "-o", out}, "too few pixels"},
        Bad{{folder_ / "text.png", "--width-mm", "420", "-o", out}, "text.png"},
        Bad{{folder_ / "none.png", "--width-mm", "420", "-o", out}, "none.png"},
        Bad{{poster, "--width-mm", "0", "-o", out}, "--width-mm"},
        Bad{{poster, "--width-mm", "-4", "-o", out}, "--width-mm"},
        Bad{{poster, "--width-mm", "nan", "-o", out}, "--width-mm"},
        Bad{{poster, "--width-mm", "1e9", "-o", out}, "larger than 1 km"},
        Bad{{poster, "-o", out}, "--width-mm"}, Bad{{poster, "--width-mm", "420"}, "--output"},
        Bad{{poster, "--width-mm", "420", "-o", ""}, "--output"},
        Bad{{poster, "--width-mm", "420", "-o", out, "--name", ""}, "--name"},
        Bad{{poster, "--width-mm", "420", "-o", folder_ / "no/x.target"}, "no/x.target"},
        Bad{{poster, "--width-mm", "420", "-o", out, "--preview", folder_ / "no/p.png"},
            "no/p.png"},
        Bad{{poster, "--width-mm", "420", "-o", folder_ / "no/x.target", "--preview",
             folder_ / "p.png"},
            "no/x.target"}}) {
    SCOPED_TRACE(message);
    std::vector<std::string> all{"target"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    ExpectRefused(RunPleinair(all), message);
    EXPECT_EQ(Listing(folder_.path()), before);
  }
}

TEST_F(Target, FileThatIsNoneIsRefusedByName) {
  ASSERT_EQ(Make().exit_code, 0);
  const std::string whole = ReadFile(folder_ / "poster.target");
  const std::string picture = Save("wall.png", With({110, 60}, poster_));
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 1);
  std::string later = whole;
  later[8] = 9;
  for (const auto& [content, message] :
       {std::pair{whole.substr(0, whole.size() - 7), std::string("is cut short")},
        {whole.substr(0, 11), "is cut short"},
        {damaged, "checksum"},
        {later, "version 9"},
        {std::string("P5 1 1 255 x"), "is no target file"},
        {std::string(), "is no target file"}}) {
    WriteFile(folder_ / "poster.target", content);
    ExpectRefused(Detect({picture}), "poster.target: ");
    ExpectRefused(Detect({picture}), message);
  }
  WriteFile(folder_ / "poster.target", whole);
  ExpectRefused(Detect({picture, "--target", folder_ / "none.target"}), "none.target");
  // Markers need a size, and a detection without any target is an error.
  ExpectRefused(Detect({picture, "--family", "sg"}), "--size-mm");
  ExpectRefused(RunPleinair({"detect", picture, "--calibration", folder_ / "camera.yaml"}),
                "--size-mm");
  ExpectRefused(Detect({picture, "--size-mm", "-1"}), "--size-mm");
}

}  // namespace
}  // namespace pleinair::e2e
