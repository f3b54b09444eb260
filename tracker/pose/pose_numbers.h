#pragma once

// Internal: between the .cc files of tracker and calibration; not installed.

#include <ceres/rotation.h>

#include <array>

#include "base/frames.h"

namespace pleinair::tracker {

/// A rigid transform as parameters of a least-squares problem: rotation vector (radians) and
/// translation (metres).
constexpr int kPoseNumbers = 6;
using PoseNumbers = std::array<double, kPoseNumbers>;

/// Parameters of a transform.
template <typename To, typename From>
PoseNumbers NumbersOf(const Transform<To, From>& pose) {
  PoseNumbers numbers{};
  ceres::RotationMatrixToAngleAxis(ceres::RowMajorAdapter3x3(pose.rotation.m.data()),
                                   numbers.data());
  numbers[3] = pose.translation_m.x;
  numbers[4] = pose.translation_m.y;
  numbers[5] = pose.translation_m.z;
  return numbers;
}

/// The transform with these parameters.
template <typename To>
Transform<To, Marker> PoseOf(const PoseNumbers& numbers) {
  Transform<To, Marker> pose;
  ceres::AngleAxisToRotationMatrix(numbers.data(),
                                   ceres::RowMajorAdapter3x3(pose.rotation.m.data()));
  pose.translation_m = {numbers[3], numbers[4], numbers[5]};
  return pose;
}

}  // namespace pleinair::tracker
