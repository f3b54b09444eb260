// Tests how near to the optimal pose the refinement of planar_pose.h ends.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/tracker/marker_rendering.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::tracker {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector8 = Eigen::Matrix<double, 8, 1>;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// camera_from_marker' = (Exp(w) R, (1 + d) t), d per coordinate, relative to the distance.
Transform<Camera, Marker> Moved(const Transform<Camera, Marker>& pose, const Vector6& move) {
  Transform<Camera, Marker> moved = pose;
  const Eigen::Vector3d w = move.head<3>();
  if (w.norm() > 0.0) {
    const RowMajor3 rotation = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix() *
                               Eigen::Map<const RowMajor3>(pose.rotation.m.data());
    Eigen::Map<RowMajor3>(moved.rotation.m.data()) = rotation;
  }
  moved.translation_m =
      pose.translation_m + Vec3{move[3], move[4], move[5]} * Norm(pose.translation_m);
  return moved;
}

/// Distance between a pose and the nearest least-squares pose, in standard deviations of the
/// corners. Levenberg–Marquardt with numerical differences of projected corners, until χ² falls by
/// less than 1e-13.
double FromTheMinimum(const CameraModel& camera, const RenderedMarker& marker,
                      const std::array<Vec2, 4>& corners, double sigma_px,
                      const Transform<Camera, Marker>& pose) {
  const auto errors = [&](const Transform<Camera, Marker>& at) {
    RenderedMarker observed = marker;
    observed.camera_from_marker = at;
    const std::array<Vec2, 4> projected = TrueCorners(camera, observed);
    Vector8 all;
    for (int i = 0; i < 4; ++i) {
      const Vec2 error = (projected[i] - corners[i]) * (1.0 / sigma_px);
      all.segment<2>(2 * i) << error.x, error.y;
    }
    return all;
  };
  Transform<Camera, Marker> best = pose;
  double damping = 1e-6;
  for (int step = 0; step < 500 && damping < 1e6; ++step) {
    const Vector8 here = errors(best);
    Eigen::Matrix<double, 8, 6> jacobian;
    for (int k = 0; k < 6; ++k) {
      constexpr double kDifference = 1e-5;
      const Vector6 move = Vector6::Unit(k) * kDifference;
      jacobian.col(k) =
          (errors(Moved(best, move)) - errors(Moved(best, -move))) / (2.0 * kDifference);
    }
    Eigen::Matrix<double, 6, 6> information = jacobian.transpose() * jacobian;
    information.diagonal() *= 1.0 + damping;
    const auto moved = Moved(best, -information.ldlt().solve(jacobian.transpose() * here));
    const double gain = here.squaredNorm() - errors(moved).squaredNorm();
    if (gain < 0.0) {
      damping = std::max(10.0 * damping, 1e-3);
      continue;
    }
    best = moved;
    if (gain <= 1e-13 * here.squaredNorm() && damping <= 1e-6) break;
    damping = std::max(0.1 * damping, 1e-6);
  }
  return (errors(best) - errors(pose)).norm();
}

struct Seen {
  const char* name;
  double side_px, tilt_deg;
};

class PoseRefinement : public testing::TestWithParam<Seen> {};
INSTANTIATE_TEST_SUITE_P(PlanarPose, PoseRefinement,
                         testing::Values(Seen{"Frontal", 120, 0}, Seen{"SmallAndFrontal", 14, 0},
                                         Seen{"Ambiguous", 14, 7}, Seen{"Undecided", 30, 5},
                                         Seen{"Tilted", 120, 50}, Seen{"Steep", 60, 78}),
                         [](const auto& observed) { return observed.param.name; });

// A step that reduces χ² by 1e-8 moves the corners by 1e-4 of their error. The pose must end about
// that close to the minimum for every view. No sequence of short steps may stop on the way.
TEST_P(PoseRefinement, EndsTwoTenThousandthsOfTheCornersErrorFromTheMinimum) {
  CameraModel camera{.width = 640, .height = 480, .fx = 600, .fy = 605, .cx = 322, .cy = 238};
  camera.distortion = {-0.13, 0.045, 0.0006, -0.0004, 0, 0, 0, 0};
  std::mt19937 random(31);
  for (const double sigma_px : {0.02, 0.3}) {
    std::normal_distribution<double> noise(0.0, sigma_px);
    for (int draw = 0; draw < 40; ++draw) {
      RenderedMarker marker;
      marker.camera_from_marker =
          PoseAtPixel(camera, {330, 250}, GetParam().side_px, marker.size,
                      FromDegrees(GetParam().tilt_deg), FromDegrees(25 + draw), FromDegrees(40));
      std::array<Vec2, 4> corners = TrueCorners(camera, marker);
      for (Vec2& corner : corners) corner = corner + Vec2{noise(random), noise(random)};
      const auto pose =
          EstimatePlanarPose(camera, corners, IsotropicCornerCovariance(sigma_px), marker.size);
      ASSERT_TRUE(pose.has_value());
      EXPECT_LT(FromTheMinimum(camera, marker, corners, sigma_px, pose->best.camera_from_marker),
                2e-4 * std::sqrt(1.0 + pose->best.chi2))
          << draw;
    }
  }
}

}  // namespace
}  // namespace pleinair::tracker
