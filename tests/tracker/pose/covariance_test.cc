// Normalised estimation error squared (Bar-Shalom, Li & Kirubarajan 2001, section 5.4). With a
// correct covariance P, eᵀ P⁻¹ e has the mean 6 for a pose.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "tests/tracker/marker_rendering.h"
#include "tests/tracker/pose_error.h"
#include "tracker/april_tag_detector.h"
#include "tracker/pose/planar_pose.h"
#include "tracker/tracker.h"

namespace pleinair::tracker {
namespace {

using Matrix8 = Eigen::Matrix<double, 8, 8>;

double Nees(const PoseEstimate& estimate, const Transform<Camera, Marker>& truth) {
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> covariance(
      estimate.covariance.data());
  EXPECT_LT((covariance - covariance.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::Matrix<double, 6, 1> error = PoseError(estimate.best.camera_from_marker, truth);
  return error.dot(covariance.ldlt().solve(error));
}

/// Half width of the 95 % band of the mean of `count` draws of χ² with 6 degrees of freedom.
double Band(int count) { return 1.96 * std::sqrt(2.0 * 6.0 / count); }

TEST(PoseCovariance, TellsTheTruthForGaussianNoiseOnTheCorners) {
  CameraModel camera{.width = 640, .height = 480, .fx = 600, .fy = 605, .cx = 322, .cy = 238};
  camera.distortion = {-0.13, 0.045, 0.0006, -0.0004, 0, 0, 0, 0};
  // Corners are never independent: neighbouring corners have correlated errors.
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Matrix8 mixing = 0.03 * Matrix8::Identity();
  for (int i = 0; i < 64; ++i) mixing(i / 8, i % 8) += 0.02 * normal(random);
  const Matrix8 covariance = mixing * mixing.transpose();
  CornerCovariance corner_covariance;
  Eigen::Map<Eigen::Matrix<double, 8, 8, Eigen::RowMajor>>(corner_covariance.data()) = covariance;
  for (const double tilt_deg : {20.0, 50.0, 70.0}) {
    RenderedMarker marker;
    marker.camera_from_marker =
        PoseAtPixel(camera, {400, 180}, 120, marker.size, FromDegrees(tilt_deg), FromDegrees(100),
                    FromDegrees(5));
    const std::array<Vec2, 4> truth = TrueCorners(camera, marker);
    constexpr int kDraws = 1000;
    double sum = 0.0;
    for (int draw = 0; draw < kDraws; ++draw) {
      Eigen::Matrix<double, 8, 1> white;
      for (int i = 0; i < 8; ++i) white[i] = normal(random);
      const Eigen::Matrix<double, 8, 1> noise = mixing * white;
      std::array<Vec2, 4> corners = truth;
      for (int i = 0; i < 4; ++i) corners[i] = corners[i] + Vec2{noise[2 * i], noise[2 * i + 1]};
      const auto pose = EstimatePlanarPose(camera, corners, corner_covariance, marker.size);
      ASSERT_TRUE(pose.has_value());
      sum += Nees(*pose, marker.camera_from_marker);
    }
    EXPECT_NEAR(sum / kDraws, 6.0, Band(kDraws)) << tilt_deg << " degrees";
  }
}

// The corners of a small, slightly tilted marker sometimes prefer the wrong one of two poses. The
// covariance must not exclude that.
TEST(PoseCovariance, CountsWithTheOtherPoseWhereTheCornersHardlyTellThemApart) {
  const CameraModel camera{.width = 640, .height = 480, .fx = 600, .fy = 605, .cx = 322, .cy = 238};
  RenderedMarker marker;
  marker.camera_from_marker = PoseAtPixel(camera, {400, 180}, 24, marker.size, FromDegrees(12),
                                          FromDegrees(100), FromDegrees(5));
  const std::array<Vec2, 4> truth = TrueCorners(camera, marker);
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, 0.06);
  constexpr int kDraws = 1000;
  double sum = 0.0;
  int wrong = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::array<Vec2, 4> corners = truth;
    for (Vec2& corner : corners) {
      corner.x += normal(random);
      corner.y += normal(random);
    }
    const auto pose =
        EstimatePlanarPose(camera, corners, IsotropicCornerCovariance(0.06), marker.size);
    ASSERT_TRUE(pose.has_value());
    sum += Nees(*pose, marker.camera_from_marker);
    const auto error = PoseError(pose->best.camera_from_marker, marker.camera_from_marker);
    if (error.head<3>().norm() > FromDegrees(12).value()) ++wrong;
  }
  RecordProperty("mean_nees", std::to_string(sum / kDraws));
  EXPECT_GT(wrong, kDraws / 50);
  EXPECT_NEAR(sum / kDraws, 6.0, 2.0);
}

// From the image noise to the pose, through the whole tracker. The covariance takes the noise from
// the residuals and adds a floor of a hundredth of a pixel in the corners. It may be somewhat too
// wide, but never too narrow.
TEST(PoseCovariance, IsNotTooNarrowForNoiseInThePicture) {
  const CameraModel camera{.width = 112, .height = 96, .fx = 200, .fy = 200, .cx = 56, .cy = 47};
  RenderedMarker marker;
  marker.pattern = AprilTagPattern("tag36h11", 2);
  const auto tracker = *Tracker::Create(camera, {.marker_size_m = marker.size.value()});
  double sum = 0.0;
  constexpr int kDraws = 150;
  for (int draw = 0; draw < kDraws; ++draw) {
    marker.camera_from_marker =
        PoseAtPixel(camera, {55.0 + 0.01 * draw, 48.0 - 0.02 * draw}, 56, marker.size,
                    FromDegrees(40), FromDegrees(2.4 * draw), FromDegrees(3.7 * draw));
    RenderingOptions options{.blur_px = 0.5, .noise_codes = 5.0, .light = {}};
    options.seed = static_cast<std::uint32_t>(draw + 1);
    const auto observations = tracker->Track(RenderMarkers(camera, {marker}, options).view());
    ASSERT_TRUE(observations.has_value());
    ASSERT_EQ(observations->size(), 1U);
    sum += Nees((*observations)[0].pose, marker.camera_from_marker);
  }
  RecordProperty("mean_nees", std::to_string(sum / kDraws));
  EXPECT_LT(sum / kDraws, 6.0 + Band(kDraws));
  EXPECT_GT(sum / kDraws, 3.0);
}

}  // namespace
}  // namespace pleinair::tracker
