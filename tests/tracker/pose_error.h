#pragma once

#include <Eigen/Dense>

#include "base/frames.h"

namespace pleinair::tracker {

/// (w, d), rad and m in the camera frame, where camera_from_marker(estimate) = (Exp(w) R_true,
/// t_true + d).
inline Eigen::Matrix<double, 6, 1> PoseError(const Transform<Camera, Marker>& estimate,
                                             const Transform<Camera, Marker>& truth) {
  using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Matrix3d difference =
      Eigen::Map<const RowMajor3>(estimate.rotation.m.data()) *
      Eigen::Map<const RowMajor3>(truth.rotation.m.data()).transpose();
  const Eigen::AngleAxisd turn(difference);
  const Vec3 d = estimate.translation_m - truth.translation_m;
  Eigen::Matrix<double, 6, 1> error;
  error << turn.angle() * turn.axis(), d.x, d.y, d.z;
  return error;
}

}  // namespace pleinair::tracker
