// The bundled path-traced recording against its true camera poses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "base/units.h"
#include "tracker/tracker.h"

namespace pleinair::tracker {
namespace {

const std::string kRecording = PLEINAIR_SOURCE_DIR "/recordings/courtyard_midday/";

/// "t_s tx ty tz qx qy qz qw", x_marker = R(q) x_camera + t.
std::vector<Transform<Marker, Camera>> ReadTruth() {
  std::ifstream file(kRecording + "truth.tum");
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

double Percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

TEST(CourtyardMidday, GivesEveryPoseWithinAThirtiethOfADegree) {
  const auto description = nlohmann::json::parse(std::ifstream(kRecording + "recording.json"));
  const auto& calibration = description["calibration"];
  CameraModel camera{.width = calibration["image_width"],
                     .height = calibration["image_height"],
                     .fx = calibration["fx"],
                     .fy = calibration["fy"],
                     .cx = calibration["cx"],
                     .cy = calibration["cy"]};
  const std::vector<Transform<Marker, Camera>> truth = ReadTruth();
  ASSERT_EQ(truth.size(), 90U);
  const auto tracker = *Tracker::Create(camera, {.marker_size_m = description["marker"]["size_m"]});
  std::vector<double> rotation_deg, translation_percent;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "frames/%04zu.jpg", i);
    cv::Mat grey;
    cv::cvtColor(cv::imread(kRecording + name), grey, cv::COLOR_BGR2GRAY);
    const auto sightings = tracker->Track(
        {grey.data, grey.cols, grey.rows, 1, static_cast<std::ptrdiff_t>(grey.step)});
    ASSERT_TRUE(sightings.has_value());
    ASSERT_EQ(sightings->size(), 1U) << name;
    const auto& estimate = (*sightings)[0].pose.best.camera_from_marker;
    const Transform<Camera, Marker> expected = truth[i].Inverse();
    const Mat3 difference = estimate.rotation * expected.rotation.Transposed();
    const double sine =
        0.5 * Norm(Vec3{difference(2, 1) - difference(1, 2), difference(0, 2) - difference(2, 0),
                        difference(1, 0) - difference(0, 1)});
    const double cosine = 0.5 * (difference(0, 0) + difference(1, 1) + difference(2, 2) - 1.0);
    rotation_deg.push_back(ToDegrees(Radians(std::atan2(sine, cosine))));
    translation_percent.push_back(100.0 * Norm(estimate.translation_m - expected.translation_m) /
                                  Norm(expected.translation_m));
  }
  EXPECT_LT(Percentile(rotation_deg, 0.5), 0.03);
  EXPECT_LT(Percentile(rotation_deg, 0.95), 0.1);
  EXPECT_LT(Percentile(translation_percent, 0.5), 0.02);
  EXPECT_LT(Percentile(translation_percent, 0.95), 0.1);
}

}  // namespace
}  // namespace pleinair::tracker
