// Tests what `pleinair detect` prints for a rendered image, field by field.
#include "app/commands/detect_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>

#include "tests/tracker/marker_rendering.h"
#include "tracker/april_tag_detector.h"

namespace pleinair::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using tracker::RenderedMarker;

const CameraModel kCamera{.width = 320, .height = 240, .fx = 400, .fy = 402, .cx = 161, .cy = 118};

class DetectCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("detect_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "camera.yaml")
        << "%YAML:1.0\n---\nimage_width: 320\nimage_height: 240\n"
           "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
           "   data: [ 400., 0., 161., 0., 402., 118., 0., 0., 1. ]\n"
           "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
           "   data: [ 0., 0., 0., 0., 0. ]\n";
    arguments_.calibration = (folder_ / "camera.yaml").string();
    arguments_.size_mm = 100.0;
  }

  void TearDown() override { std::filesystem::remove_all(folder_); }

  void AddImage(const std::string& name, const std::vector<RenderedMarker>& markers) {
    GreyImage image = tracker::RenderMarkers(kCamera, markers, {});
    const std::string path = (folder_ / name).string();
    ASSERT_TRUE(cv::imwrite(path, cv::Mat(image.height(), image.width(), CV_8U, image.data())));
    arguments_.pictures.push_back(path);
  }

  static RenderedMarker Marker() {
    RenderedMarker marker;
    marker.pattern = tracker::AprilTagPattern("tag36h11", 17);
    marker.camera_from_marker = tracker::PoseAtPixel(
        kCamera, {150, 120}, 90, marker.size, FromDegrees(35), FromDegrees(60), FromDegrees(20));
    return marker;
  }

  std::filesystem::path folder_;
  DetectArguments arguments_;
};

TEST_F(DetectCommand, PrintsEveryFieldOfTheContractOneLineAPicture) {
  const RenderedMarker marker = Marker();
  AddImage("tag.png", {marker});
  AddImage("empty.png", {});
  std::ostringstream out;
  const Result<void> result = RunDetect(arguments_, out);
  ASSERT_TRUE(result.has_value()) << result.error().Message();
  std::istringstream lines(out.str());
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  const json first = json::parse(line);
  EXPECT_EQ(first.at("file"), arguments_.pictures[0]);
  EXPECT_GT(first.at("milliseconds").get<double>(), 0.0);
  ASSERT_EQ(first.at("markers").size(), 1U);
  const json& found = first["markers"][0];
  EXPECT_EQ(found.at("family"), "tag36h11");
  EXPECT_EQ(found.at("id"), 17);
  EXPECT_EQ(found.at("path"), "fast");
  EXPECT_NEAR(found.at("visible_fraction").get<double>(), 1.0, 0.05);

  const std::array<Vec2, 4> corners = tracker::TrueCorners(kCamera, marker);
  ASSERT_EQ(found.at("corners").size(), 4U);
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(found["corners"][i].size(), 2U);
    EXPECT_NEAR(found["corners"][i][0].get<double>(), corners[i].x, 0.05);
    EXPECT_NEAR(found["corners"][i][1].get<double>(), corners[i].y, 0.05);
  }

  const json& pose = found.at("camera_from_marker");
  const Mat3& rotation = marker.camera_from_marker.rotation;
  ASSERT_EQ(pose.at("rotation").size(), 9U);
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(pose["rotation"][i].get<double>(), rotation.m[i], 1e-3) << "row-major entry " << i;
  }
  const Vec3 translation = marker.camera_from_marker.translation_m;
  ASSERT_EQ(pose.at("translation_m").size(), 3U);
  EXPECT_NEAR(pose["translation_m"][0].get<double>(), translation.x, 2e-4);
  EXPECT_NEAR(pose["translation_m"][1].get<double>(), translation.y, 2e-4);
  EXPECT_NEAR(pose["translation_m"][2].get<double>(), translation.z, 2e-4);

  ASSERT_EQ(found.at("covariance").size(), 36U);
  for (int i = 0; i < 6; ++i) {
    EXPECT_GT(found["covariance"][7 * i].get<double>(), 0.0);
    for (int j = 0; j < i; ++j) {
      EXPECT_DOUBLE_EQ(found["covariance"][6 * i + j].get<double>(),
                       found["covariance"][6 * j + i].get<double>());
    }
  }
  // The second planar solution has its own pose, or is null.
  const json& alternative = found.at("alternative");
  if (!alternative.is_null()) {
    EXPECT_EQ(alternative.at("camera_from_marker").at("rotation").size(), 9U);
    EXPECT_EQ(alternative.at("camera_from_marker").at("translation_m").size(), 3U);
  }

  ASSERT_TRUE(std::getline(lines, line));
  const json second = json::parse(line);
  EXPECT_EQ(second.at("file"), arguments_.pictures[1]);
  EXPECT_TRUE(second.at("markers").is_array());
  EXPECT_TRUE(second["markers"].empty());
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(DetectCommand, WritesNothingWhenALaterPictureIsMissing) {
  AddImage("tag.png", {Marker()});
  arguments_.pictures.push_back((folder_ / "missing.png").string());
  std::ostringstream out;
  const Result<void> result = RunDetect(arguments_, out);
  ASSERT_FALSE(result.has_value());
  EXPECT_THAT(result.error().Message(), HasSubstr("missing.png"));
  EXPECT_EQ(out.str(), "");
}

TEST_F(DetectCommand, NamesTheFamilyItDoesNotKnow) {
  AddImage("tag.png", {});
  arguments_.families = {"qr"};
  std::ostringstream out;
  const Result<void> result = RunDetect(arguments_, out);
  ASSERT_FALSE(result.has_value());
  EXPECT_THAT(result.error().Message(), HasSubstr("qr"));
  EXPECT_THAT(result.error().Message(), HasSubstr("tag36h11"));
}

}  // namespace
}  // namespace pleinair::app
