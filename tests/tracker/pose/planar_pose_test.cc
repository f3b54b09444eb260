#include "tracker/pose/planar_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/tracker/marker_rendering.h"

namespace pleinair::tracker {
namespace {

CameraModel Camera640() {
  return {.width = 640, .height = 480, .fx = 600, .fy = 600, .cx = 319.5, .cy = 239.5};
}

RenderedMarker MarkerAt(const CameraModel& camera, Vec2 centre_px, double side_px,
                        double tilt_deg) {
  RenderedMarker marker;
  marker.camera_from_marker = PoseAtPixel(camera, centre_px, side_px, marker.size,
                                          FromDegrees(tilt_deg), FromDegrees(25), FromDegrees(40));
  return marker;
}

double MaxDifference(const Transform<Camera, Marker>& a, const Transform<Camera, Marker>& b) {
  double most = Norm(a.translation_m - b.translation_m);
  for (int i = 0; i < 9; ++i) {
    most = std::max(most, std::fabs(a.rotation.m[i] - b.rotation.m[i]));
  }
  return most;
}

TEST(PlanarPose, ComesBackFromExactCornersThroughEveryLens) {
  CameraModel barrel = Camera640();
  barrel.distortion = {-0.3, 0.1, 0.001, -0.002, 0, 0, 0, 0};
  CameraModel fisheye = Camera640();
  fisheye.distortion_model = DistortionModel::kEquidistant;
  fisheye.distortion = {0.03, -0.01, 0.002, 0, 0, 0, 0, 0};
  for (const CameraModel& camera : {Camera640(), barrel, fisheye}) {
    for (const double tilt_deg : {5.0, 30.0, 60.0, 80.0}) {
      const RenderedMarker marker = MarkerAt(camera, {200, 330}, 120, tilt_deg);
      const auto pose = EstimatePlanarPose(camera, TrueCorners(camera, marker),
                                           IsotropicCornerCovariance(0.1), marker.size);
      ASSERT_TRUE(pose.has_value());
      EXPECT_LT(MaxDifference(pose->best.camera_from_marker, marker.camera_from_marker), 1e-6);
      EXPECT_LT(pose->best.reprojection_rms_px, 1e-6);
      EXPECT_LT(pose->ambiguity_ratio, 0.1);
    }
  }
}

TEST(PlanarPose, OfASquareAsThePrintIsReadHasItsFaceTowardsTheCamera) {
  const CameraModel camera = Camera640();
  const std::array<Vec2, 4> corners{{{300, 200}, {340, 200}, {340, 240}, {300, 240}}};
  const auto pose =
      EstimatePlanarPose(camera, corners, IsotropicCornerCovariance(0.1), Metres(0.1));
  ASSERT_TRUE(pose.has_value());
  const Mat3& rotation = pose->best.camera_from_marker.rotation;
  EXPECT_GT(rotation(0, 0), 0.9);   // x right in the image,
  EXPECT_LT(rotation(1, 1), -0.9);  // y up,
  EXPECT_LT(rotation(2, 2), -0.9);  // z towards the camera.
}

// Schweighofer & Pinz 2006: a small, distant, slightly tilted target has two poses with similar
// errors. Half a pixel of noise makes them indistinguishable.
TEST(PlanarPose, ReportsTheOtherSolutionWhereTheTargetIsSmallAndNearlyFrontal) {
  const CameraModel camera = Camera640();
  const RenderedMarker marker = MarkerAt(camera, {330, 250}, 15, 20);
  std::array<Vec2, 4> corners = TrueCorners(camera, marker);
  const std::array<Vec2, 4> noise{{{0.2, -0.1}, {-0.15, 0.2}, {0.1, 0.1}, {-0.05, -0.2}}};
  for (int i = 0; i < 4; ++i) corners[i] = corners[i] + noise[i];
  const auto pose =
      EstimatePlanarPose(camera, corners, IsotropicCornerCovariance(0.2), marker.size);
  ASSERT_TRUE(pose.has_value());
  ASSERT_TRUE(pose->alternative.has_value());
  EXPECT_GT(pose->ambiguity_ratio, 0.5);
  EXPECT_LE(pose->ambiguity_ratio, 1.0);
  const double nearer =
      std::min(MaxDifference(pose->best.camera_from_marker, marker.camera_from_marker),
               MaxDifference(pose->alternative->camera_from_marker, marker.camera_from_marker));
  EXPECT_LT(nearer, 0.2);
}

TEST(PlanarPose, GoesOnFromTheRotationBeforeWhereTheCornersDoNotDecide) {
  const CameraModel camera = Camera640();
  const RenderedMarker marker = MarkerAt(camera, {330, 250}, 15, 20);
  const std::array<Vec2, 4> corners = TrueCorners(camera, marker);
  const CornerCovariance covariance = IsotropicCornerCovariance(0.2);
  const auto alone = EstimatePlanarPose(camera, corners, covariance, marker.size);
  ASSERT_TRUE(alone.has_value() && alone->alternative.has_value());
  const Mat3& other = alone->alternative->camera_from_marker.rotation;
  const auto turned = EstimatePlanarPose(camera, corners, covariance, marker.size, &other);
  ASSERT_TRUE(turned.has_value());
  EXPECT_EQ(turned->best.camera_from_marker.rotation, other);
  // Accurate corners are unambiguous.
  const auto sharp =
      EstimatePlanarPose(camera, corners, IsotropicCornerCovariance(0.001), marker.size, &other);
  ASSERT_TRUE(sharp.has_value());
  EXPECT_LT(MaxDifference(sharp->best.camera_from_marker, marker.camera_from_marker), 1e-4);
}

// The reported ambiguity ratio must equal the observed odds for errors with the given covariance.
// It must never be overconfident.
TEST(PlanarPose, StatesARatioThatComesTrueAmongSmallTargets) {
  const CameraModel camera = Camera640();
  std::mt19937 random(5);
  constexpr double kSigma_px = 0.03;
  std::normal_distribution<double> normal(0.0, kSigma_px);
  double expected = 0.0;
  int wrong = 0, wrong_and_certain = 0, certain = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const RenderedMarker marker = MarkerAt(camera, {330, 250}, 14, 4.0 + draw % 40);
    std::array<Vec2, 4> corners = TrueCorners(camera, marker);
    for (Vec2& corner : corners) corner = corner + Vec2{normal(random), normal(random)};
    const auto pose =
        EstimatePlanarPose(camera, corners, IsotropicCornerCovariance(kSigma_px), marker.size);
    ASSERT_TRUE(pose.has_value());
    if (!pose->alternative) continue;
    const auto off = [&](const PoseSolution& solution) {
      return MaxDifference(solution.camera_from_marker, marker.camera_from_marker);
    };
    const bool is_wrong = off(*pose->alternative) < off(pose->best);
    const bool is_certain = pose->ambiguity_ratio < kCertainRatio;
    expected += pose->ambiguity_ratio / (1.0 + pose->ambiguity_ratio);
    wrong += is_wrong;
    certain += is_certain;
    wrong_and_certain += is_wrong && is_certain;
  }
  EXPECT_GT(wrong, 60);
  EXPECT_GT(certain, 500);
  EXPECT_EQ(wrong_and_certain, 0);
  EXPECT_LT(wrong, 1.1 * expected);
  EXPECT_GT(wrong, 0.7 * expected);
}

TEST(PlanarPose, HasALowAmbiguityRatioWhereTheTargetIsLargeAndTilted) {
  const CameraModel camera = Camera640();
  const RenderedMarker marker = MarkerAt(camera, {330, 250}, 200, 45);
  std::array<Vec2, 4> corners = TrueCorners(camera, marker);
  corners[0] = corners[0] + Vec2{0.1, -0.1};
  const auto pose =
      EstimatePlanarPose(camera, corners, IsotropicCornerCovariance(0.1), marker.size);
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT(pose->ambiguity_ratio, 0.05);
}

TEST(PlanarPose, IsNotGivenForCornersThatAreNoSquare) {
  const CameraModel camera = Camera640();
  const std::array<Vec2, 4> point{{{300, 200}, {300, 200}, {300, 200}, {300, 200}}};
  EXPECT_FALSE(EstimatePlanarPose(camera, point, IsotropicCornerCovariance(0.1), Metres(0.1)));
  const double nan = std::nan("");
  const std::array<Vec2, 4> broken{{{nan, 200}, {340, 200}, {340, 240}, {300, 240}}};
  EXPECT_FALSE(EstimatePlanarPose(camera, broken, IsotropicCornerCovariance(0.1), Metres(0.1)));
}

}  // namespace
}  // namespace pleinair::tracker
