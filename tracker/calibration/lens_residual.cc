#include "tracker/calibration/lens_residual.h"

#include <ceres/jet.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {
namespace {

/// Derivatives of DistortNormalized (base/camera_model.h) by the coefficients, x before y.
std::array<std::array<double, 8>, 2> ByCoefficients(const CameraModel& camera, double x, double y) {
  std::array<std::array<double, 8>, 2> by{};
  const auto& d = camera.distortion;
  const double r2 = x * x + y * y;
  if (camera.distortion_model == DistortionModel::kEquidistant) {
    const double r = std::sqrt(r2), theta = std::atan(r);
    double power = r < 1e-8 ? 0.0 : theta / r;
    for (std::size_t i = 0; i < 4; ++i) {
      power *= theta * theta;
      by[0][i] = x * power;
      by[1][i] = y * power;
    }
    return by;
  }
  const double above = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  const double below = 1.0 + r2 * (d[5] + r2 * (d[6] + r2 * d[7]));
  const double powers[3] = {r2, r2 * r2, r2 * r2 * r2};
  constexpr std::size_t kAbove[3] = {0, 1, 4};
  for (std::size_t i = 0; i < 3; ++i) {
    const double numerator = powers[i] / below, denominator = -above / below * numerator;
    by[0][kAbove[i]] = x * numerator;
    by[1][kAbove[i]] = y * numerator;
    by[0][5 + i] = x * denominator;
    by[1][5 + i] = y * denominator;
  }
  by[0][2] = by[1][3] = 2.0 * x * y;
  by[0][3] = r2 + 2.0 * x * x;
  by[1][2] = r2 + 2.0 * y * y;
  return by;
}

}  // namespace

LensNumbers NumbersOf(const CameraModel& camera) {
  LensNumbers numbers{camera.fx, camera.fy, camera.cx, camera.cy};
  std::copy(camera.distortion.begin(), camera.distortion.end(), numbers.begin() + 4);
  return numbers;
}

void SetLensNumbers(const double* numbers, CameraModel* camera) {
  camera->fx = numbers[0];
  camera->fy = numbers[1];
  camera->cx = numbers[2];
  camera->cy = numbers[3];
  std::copy_n(numbers + 4, camera->distortion.size(), camera->distortion.begin());
}

Vec2 ProjectBoardPoint(const CameraModel& camera, const double* pose, Vec2 on_board_m,
                       PixelDerivatives* derivatives) {
  using ByPose = ceres::Jet<double, kPoseNumbers>;
  ByPose numbers[kPoseNumbers];
  for (int i = 0; i < kPoseNumbers; ++i) numbers[i] = ByPose(pose[i], i);
  const ByPose point[3] = {ByPose(on_board_m.x), ByPose(on_board_m.y), ByPose(0.0)};
  ByPose in_camera[3];
  ceres::AngleAxisRotatePoint(numbers, point, in_camera);
  for (int i = 0; i < 3; ++i) in_camera[i] += numbers[3 + i];
  constexpr double kMinDistance = 1e-3;  // Relative to its distance.
  const double nearest =
      kMinDistance * (std::fabs(pose[3]) + std::fabs(pose[4]) + std::fabs(pose[5]));
  if (!(in_camera[2].a > nearest)) in_camera[2] = ByPose(nearest);
  const ByPose x = in_camera[0] / in_camera[2], y = in_camera[1] / in_camera[2];
  ByPose x_distorted, y_distorted;
  DistortNormalized(camera, x, y, &x_distorted, &y_distorted);
  const Vec2 pixel{camera.fx * x_distorted.a + camera.cx, camera.fy * y_distorted.a + camera.cy};
  if (derivatives == nullptr) return pixel;
  const auto by_coefficients = ByCoefficients(camera, x.a, y.a);
  derivatives->by_lens.fill(0.0);
  derivatives->by_lens[0] = x_distorted.a;
  derivatives->by_lens[kLensNumbers + 1] = y_distorted.a;
  derivatives->by_lens[2] = derivatives->by_lens[kLensNumbers + 3] = 1.0;
  for (std::size_t i = 0; i < 8; ++i) {
    derivatives->by_lens[4 + i] = camera.fx * by_coefficients[0][i];
    derivatives->by_lens[kLensNumbers + 4 + i] = camera.fy * by_coefficients[1][i];
  }
  for (int i = 0; i < kPoseNumbers; ++i) {
    derivatives->by_pose[static_cast<std::size_t>(i)] = camera.fx * x_distorted.v[i];
    derivatives->by_pose[static_cast<std::size_t>(kPoseNumbers + i)] = camera.fy * y_distorted.v[i];
  }
  return pixel;
}

}  // namespace pleinair::tracker
