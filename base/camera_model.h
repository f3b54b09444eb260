#pragma once

#include <array>
#include <cmath>

#include "base/frames.h"
#include "base/vector.h"

namespace pleinair {

/// Lens distortion models, as defined by OpenCV 4.6, module calib3d.
enum class DistortionModel {
  kBrownConrady,  ///< "radtan", "plumb_bob", rational: k1 k2 p1 p2 k3 k4 k5 k6.
  kEquidistant,   ///< OpenCV fisheye, Kalibr "equidistant": k1 k2 k3 k4, polynomial in the angle.
};

/// Intrinsics of a camera. Pixel coordinates as in base/pixel_origin.h (integer = pixel centre).
struct CameraModel {
  int width = 0;
  int height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;
  DistortionModel distortion_model = DistortionModel::kBrownConrady;
  /// kBrownConrady: k1 k2 p1 p2 k3 k4 k5 k6; kEquidistant: k1 k2 k3 k4 0 0 0 0.
  std::array<double, 8> distortion{};

  bool HasDistortion() const {
    for (const double k : distortion) {
      if (k != 0.0) return true;
    }
    return distortion_model == DistortionModel::kEquidistant;
  }
};

/// Distorts a normalised image point (X/Z, Y/Z). `T` is double or an automatic-differentiation
/// type.
template <typename T>
void DistortNormalized(const CameraModel& camera, const T& x, const T& y, T* x_distorted,
                       T* y_distorted) {
  const auto& d = camera.distortion;
  const T r2 = x * x + y * y;
  if (camera.distortion_model == DistortionModel::kEquidistant) {
    using std::atan;
    using std::sqrt;
    if (r2 < T(1e-16)) {
      *x_distorted = x;
      *y_distorted = y;
      return;
    }
    const T r = sqrt(r2);
    const T theta = atan(r);
    const T t2 = theta * theta;
    const T scale = theta * (T(1) + t2 * (d[0] + t2 * (d[1] + t2 * (d[2] + t2 * d[3])))) / r;
    *x_distorted = x * scale;
    *y_distorted = y * scale;
    return;
  }
  const T radial = (T(1) + r2 * (d[0] + r2 * (d[1] + r2 * d[4]))) /
                   (T(1) + r2 * (d[5] + r2 * (d[6] + r2 * d[7])));
  *x_distorted = x * radial + T(2.0 * d[2]) * x * y + d[3] * (r2 + T(2) * x * x);
  *y_distorted = y * radial + d[2] * (r2 + T(2) * y * y) + T(2.0 * d[3]) * x * y;
}

/// Projects a point given in the camera frame to distorted pixel coordinates. The point must lie in
/// front of the camera (z > 0).
template <typename T>
void ProjectToPixel(const CameraModel& camera, const T& x_m, const T& y_m, const T& z_m, T* u_px,
                    T* v_px) {
  T x_distorted, y_distorted;
  const T x_normalized = x_m / z_m;
  const T y_normalized = y_m / z_m;
  DistortNormalized(camera, x_normalized, y_normalized, &x_distorted, &y_distorted);
  *u_px = camera.fx * x_distorted + camera.cx;
  *v_px = camera.fy * y_distorted + camera.cy;
}

inline Vec2 ProjectToPixel(const CameraModel& camera, Point<Camera> point) {
  Vec2 pixel;
  ProjectToPixel(camera, point.xyz.x, point.xyz.y, point.xyz.z, &pixel.x, &pixel.y);
  return pixel;
}

/// Normalised undistorted coordinates (X/Z, Y/Z) of a pixel, by Newton's method with a numerical
/// Jacobian. Inverts DistortNormalized() to 1e-12 wherever the lens model is one-to-one.
inline Vec2 UndistortPixel(const CameraModel& camera, Vec2 pixel) {
  const Vec2 target{(pixel.x - camera.cx) / camera.fx, (pixel.y - camera.cy) / camera.fy};
  if (!camera.HasDistortion()) return target;
  Vec2 guess = target;
  if (camera.distortion_model == DistortionModel::kEquidistant) {
    // The distorted radius is close to the angle itself, so start from the tangent of that angle.
    const double theta = std::fmin(Norm(target), 1.5);
    if (theta > 1e-8) guess = target * (std::tan(theta) / Norm(target));
  }
  constexpr double kStep = 1e-7;
  for (int iteration = 0; iteration < 30; ++iteration) {
    Vec2 at, dx, dy;
    DistortNormalized(camera, guess.x, guess.y, &at.x, &at.y);
    DistortNormalized(camera, guess.x + kStep, guess.y, &dx.x, &dx.y);
    DistortNormalized(camera, guess.x, guess.y + kStep, &dy.x, &dy.y);
    const Vec2 error = target - at;
    const double j00 = (dx.x - at.x) / kStep, j01 = (dy.x - at.x) / kStep;
    const double j10 = (dx.y - at.y) / kStep, j11 = (dy.y - at.y) / kStep;
    const double determinant = j00 * j11 - j01 * j10;
    if (std::fabs(determinant) < 1e-12) break;
    const Vec2 step{(j11 * error.x - j01 * error.y) / determinant,
                    (j00 * error.y - j10 * error.x) / determinant};
    guess = guess + step;
    if (Norm(step) < 1e-13) break;
  }
  return guess;
}

}  // namespace pleinair
