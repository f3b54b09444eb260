#include "tracker/calibration/marker_lens.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "base/units.h"
#include "tests/tracker/marker_rendering.h"

namespace pleinair::tracker {
namespace {

using testing::AllOf;
using testing::HasSubstr;

CameraModel LensOf(int width, int height, double focal_px, Vec2 off_centre_px, double k1,
                   double k2) {
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = focal_px;
  camera.cx = 0.5 * (width - 1) + off_centre_px.x;
  camera.cy = 0.5 * (height - 1) + off_centre_px.y;
  camera.distortion[0] = k1;
  camera.distortion[1] = k2;
  return camera;
}

/// How a camera moves around a marker.
struct Motion {
  double tilt_deg = 45.0, tilt_range_deg = 15.0;
  double turn_deg = 150.0;  ///< Around the marker.
  double roam = 0.28;       ///< Amplitude of the marker's motion over the image's size.
  double side_share = 0.2;  ///< Marker's edge over the image's width.
  double distance_range = 0.3;
};

/// The corners of a marker along a film, with noise of the stated covariance: `noise_px` for each
/// coordinate and as much again for the whole marker's size and slant.
std::vector<MarkerView> ViewsOf(const CameraModel& camera, const Motion& motion, int count,
                                double noise_px, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
  const double a = phase(random), b = phase(random), c = phase(random), d = phase(random);
  std::vector<MarkerView> views;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * std::numbers::pi * i / count;
    const Vec2 centre{camera.width * (0.5 + motion.roam * std::sin(t + a)),
                      camera.height * (0.5 + motion.roam * std::sin(2.0 * t + b))};
    const double side_px =
        camera.width * motion.side_share * (1.0 + motion.distance_range * std::sin(3.0 * t + c));
    const double tilt = motion.tilt_deg + motion.tilt_range_deg * std::sin(2.0 * t + d);
    const double around = motion.turn_deg * std::sin(t + c);
    RenderedMarker marker;
    marker.size = Metres(0.2);
    marker.camera_from_marker =
        PoseAtPixel(camera, centre, side_px, marker.size, Radians(tilt * kRadiansPerDegree),
                    Radians(around * kRadiansPerDegree), Radians(0.3 * std::sin(t)));
    MarkerView view;
    view.name = "frame " + std::to_string(i);
    view.corners_px = TrueCorners(camera, marker);
    // Correlated noise, as an alignment of all cells has: C = A Aᵀ.
    Eigen::Matrix<double, 8, 8> mix = Eigen::Matrix<double, 8, 8>::Identity() * noise_px;
    for (int row = 0; row < 8; ++row) mix(row, (row + 2) % 8) += 0.5 * noise_px;
    Eigen::Matrix<double, 8, 1> draw;
    for (int k = 0; k < 8; ++k) draw[k] = normal(random);
    const Eigen::Matrix<double, 8, 1> error = mix * draw;
    const Eigen::Matrix<double, 8, 8> covariance = mix * mix.transpose();
    for (int k = 0; k < 4; ++k) {
      Vec2& corner = view.corners_px[static_cast<std::size_t>(k)];
      corner = corner + Vec2{error[2 * k], error[2 * k + 1]};
    }
    for (int row = 0; row < 8; ++row) {
      for (int column = 0; column < 8; ++column) {
        view.covariance_px2[static_cast<std::size_t>(8 * row + column)] = covariance(row, column);
      }
    }
    views.push_back(view);
  }
  return views;
}

std::string MessageOf(const Result<MarkerLens>& lens) {
  if (!lens) return lens.error().Message();
  const auto determined = CheckDetermined(*lens);
  return determined ? "" : determined.error().Message();
}

// Phones, an action camera and a webcam, with distortion and an off-centre principal point.
TEST(MarkerLens, FocalLengthIsWithinItsStatedDeviation) {
  const CameraModel cameras[] = {
      LensOf(1920, 1080, 1480.0, {9.0, -7.0}, 0.06, -0.12),   // A phone's film.
      LensOf(1080, 1920, 1480.0, {-8.0, 12.0}, 0.06, -0.12),  // Upright.
      LensOf(3840, 2160, 2700.0, {-20.0, 15.0}, -0.11, 0.05),
      LensOf(1280, 720, 780.0, {4.0, 3.0}, -0.19, 0.05),
      LensOf(640, 480, 605.0, {-2.0, 3.0}, 0.0, 0.0)};
  int within = 0, runs = 0;
  double worst = 0.0;
  for (const CameraModel& camera : cameras) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      const double noise_px = 0.03 + 0.03 * (seed % 4);
      const auto lens = EstimateMarkerLens(ViewsOf(camera, {}, 60, noise_px, 100 + seed),
                                           camera.width, camera.height);
      ASSERT_EQ(MessageOf(lens), "");
      const double error = std::fabs(lens->camera.fx - camera.fx);
      worst = std::max(worst, error / camera.fx);
      within += error <= 2.0 * lens->deviations.focal_px ? 1 : 0;
      ++runs;
      EXPECT_LT(std::fabs(lens->camera.cx - camera.cx), 4.0 * lens->deviations.cx_px);
      EXPECT_LT(std::fabs(lens->camera.distortion[0] - camera.distortion[0]),
                4.0 * lens->deviations.k1);
    }
  }
  RecordProperty("within_two_deviations", within);
  RecordProperty("largest_error_percent", std::to_string(100.0 * worst));
  EXPECT_GE(within, 95 * runs / 100);
  EXPECT_LT(worst, 0.003);
}

TEST(MarkerLens, FrontalViewsAndLittleMotionAreRefusedWithARemedy) {
  const CameraModel camera = LensOf(1920, 1080, 1480.0, {}, 0.0, 0.0);
  Motion frontal;
  frontal.tilt_deg = 2.0;
  frontal.tilt_range_deg = 2.0;
  frontal.roam = 0.04;
  EXPECT_THAT(MessageOf(EstimateMarkerLens(ViewsOf(camera, frontal, 80, 0.05, 1), 1920, 1080)),
              AllOf(HasSubstr("does not determine the lens"), HasSubstr("from several sides")));
  Motion little;
  little.tilt_range_deg = 1.0;
  little.turn_deg = 2.0;
  little.roam = 0.01;
  little.side_share = 0.08;
  little.distance_range = 0.02;
  EXPECT_THAT(MessageOf(EstimateMarkerLens(ViewsOf(camera, little, 80, 0.1, 1), 1920, 1080)),
              AllOf(HasSubstr("does not determine the lens"), HasSubstr("from several sides")));
  EXPECT_THAT(MessageOf(EstimateMarkerLens(ViewsOf(camera, {}, 7, 0.05, 1), 1920, 1080)),
              HasSubstr("7 different views"));
}

TEST(MarkerLens, AContradictingViewIsLeftOut) {
  const CameraModel camera = LensOf(1920, 1080, 1480.0, {}, 0.05, -0.1);
  auto views = ViewsOf(camera, {}, 60, 0.05, 3);
  views[20].corners_px[1].x += 6.0;
  const auto lens = EstimateMarkerLens(views, 1920, 1080, 1500.0);
  ASSERT_EQ(MessageOf(lens), "");
  EXPECT_EQ(std::count(lens->used.begin(), lens->used.end(), 20U), 0);
  EXPECT_NEAR(lens->camera.fx / camera.fx, 1.0, 0.003);
}

}  // namespace
}  // namespace pleinair::tracker
