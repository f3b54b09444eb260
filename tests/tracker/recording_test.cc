// Tests the bundled path-traced recordings against their true camera poses.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"
#include "tests/source_tree.h"
#include "tests/tracker/pose_error.h"
#include "tracker/tracker.h"

namespace pleinair::tracker {
namespace {

struct Bundled {
  const char* name;
  const char* family;
  std::size_t frames;
  bool consecutive;
  double translation_median_percent, translation_p95_percent, mean_nees;  ///< Upper limits.
};

/// "t_s tx ty tz qx qy qz qw", x_marker = R(q) x_camera + t.
std::vector<Transform<Marker, Camera>> ReadTruth(const std::string& folder) {
  std::ifstream file(folder + "truth.tum");
  std::vector<Transform<Marker, Camera>> truth;
  for (std::string line; std::getline(file, line);) {
    double t, x, y, z, a, b, c, w;
    if (std::sscanf(line.c_str(), "%lf %lf %lf %lf %lf %lf %lf %lf", &t, &x, &y, &z, &a, &b, &c,
                    &w) != 8) {
      continue;
    }
    const Mat3 rotation{{1 - 2 * (b * b + c * c), 2 * (a * b - c * w), 2 * (a * c + b * w),
                         2 * (a * b + c * w), 1 - 2 * (a * a + c * c), 2 * (b * c - a * w),
                         2 * (a * c - b * w), 2 * (b * c + a * w), 1 - 2 * (a * a + b * b)}};
    truth.push_back({rotation, {x, y, z}});
  }
  return truth;
}

/// With linear interpolation between the two nearest values.
double Percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], place - static_cast<double>(below));
}

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

class Courtyard : public testing::TestWithParam<Bundled> {};

TEST_P(Courtyard, GivesEveryPoseWithinAThirtiethOfADegree) {
  const Bundled& bundled = GetParam();
  const std::string folder = tests::SourceTree() / "recordings" / bundled.name / "";
  const auto description = nlohmann::json::parse(std::ifstream(folder + "recording.json"));
  const auto& calibration = description["calibration"];
  CameraModel camera{.width = calibration["image_width"],
                     .height = calibration["image_height"],
                     .fx = calibration["fx"],
                     .fy = calibration["fy"],
                     .cx = calibration["cx"],
                     .cy = calibration["cy"]};
  const std::vector<Transform<Marker, Camera>> truth = ReadTruth(folder);
  ASSERT_EQ(truth.size(), bundled.frames);
  const auto tracker = *Tracker::Create(camera, {.families = {bundled.family},
                                                 .marker_size_m = description["marker"]["size_m"],
                                                 .consecutive_frames = bundled.consecutive});
  std::vector<double> rotation_deg, translation_percent, nees;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "frames/%04zu.jpg", i);
    cv::Mat grey;
    cv::cvtColor(cv::imread(folder + name), grey, cv::COLOR_BGR2GRAY);
    const auto observations = tracker->Track(
        {grey.data, grey.cols, grey.rows, 1, static_cast<std::ptrdiff_t>(grey.step)});
    ASSERT_TRUE(observations.has_value());
    ASSERT_EQ(observations->size(), 1U) << name;
    const PoseEstimate& pose = (*observations)[0].pose;
    const Transform<Camera, Marker> expected = truth[i].Inverse();
    const Eigen::Matrix<double, 6, 1> error = PoseError(pose.best.camera_from_marker, expected);
    rotation_deg.push_back(ToDegrees(Radians(error.head<3>().norm())));
    translation_percent.push_back(100.0 * error.tail<3>().norm() / Norm(expected.translation_m));
    const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> covariance(
        pose.covariance.data());
    nees.push_back(error.dot(covariance.ldlt().solve(error)));
  }
  std::printf("\n%s, %zu of %zu frames | median | 95th percentile | largest\n", bundled.name,
              nees.size(), truth.size());
  for (const auto& [what, values] :
       {std::pair{"rotation, degrees", &rotation_deg},
        std::pair{"translation, % of the distance", &translation_percent},
        std::pair{"NEES (6 is right)", &nees}}) {
    std::printf("%-42s | %.4f | %.4f | %.4f\n", what, Percentile(*values, 0.5),
                Percentile(*values, 0.95), Percentile(*values, 1.0));
  }
  std::printf("%-42s | %.1f\n", "mean NEES", Mean(nees));
  std::fflush(stdout);
  EXPECT_LT(Percentile(rotation_deg, 0.5), 0.015);
  EXPECT_LT(Percentile(rotation_deg, 0.95), 0.04);
  EXPECT_LT(Percentile(translation_percent, 0.5), bundled.translation_median_percent);
  EXPECT_LT(Percentile(translation_percent, 0.95), bundled.translation_p95_percent);
  EXPECT_LT(Mean(nees), bundled.mean_nees);
}

// An S-G marker is measured by blocks in half a millisecond, where AprilTags take twenty: that
// costs accuracy, and the covariance is too narrow by what the blocks' even light leaves out.
INSTANTIATE_TEST_SUITE_P(
    Bundled, Courtyard,
    testing::Values(Bundled{"courtyard_midday", "sg", 90, true, 0.025, 0.05, 25.0},
                    Bundled{"courtyard_tag36h11", "tag36h11", 6, false, 0.01, 0.04, 15.0}),
    [](const testing::TestParamInfo<Bundled>& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pleinair::tracker
