#include "export/trajectories/camera_trajectory.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace pleinair::exports {
namespace {

// Files contain quaternions with three digits or more; a larger deviation is not a rotation.
constexpr double kLengthTolerance = 0.01;
// Beyond any camera's trajectory, and well within the range of 32-bit floats.
constexpr double kMaxDistance = 1e9;

// 285 years; leaves room for arithmetic.
constexpr std::int64_t kMaxTime_ns = 9'000'000'000'000'000'000;

bool IsNear(Vec3 place) {
  return std::abs(place.x) <= kMaxDistance && std::abs(place.y) <= kMaxDistance &&
         std::abs(place.z) <= kMaxDistance;
}

}  // namespace

Result<void> CheckPose(const std::string& where, Vec3 shift, const Quaternion& turn) {
  const double length = std::sqrt(Dot(turn, turn));
  if (!(std::abs(length - 1.0) <= kLengthTolerance)) {
    return InputError(where, fmt::format("has a quaternion of length {:.4g} instead of 1", length),
                      "correct it, or get a whole copy of the file");
  }
  if (!IsNear(shift)) {
    return InputError(where, "has a position beyond 1e9",
                      "correct it, or get a whole copy of the file");
  }
  return {};
}

Result<void> AddPose(const std::string& where, TrajectoryPose pose, CameraTrajectory* path) {
  if (!path->poses.empty() && pose.timestamp_ns <= path->poses.back().timestamp_ns) {
    return InputError(where, "is not later than the pose before", "sort the lines by time");
  }
  if (pose.timestamp_ns > kMaxTime_ns || pose.timestamp_ns < -kMaxTime_ns) {
    return InputError(where, "has a time stamp of more than 9e9 seconds",
                      "correct it, or get a whole copy of the file");
  }
  path->poses.push_back(std::move(pose));
  return {};
}

void ScaleTrajectory(double factor, CameraTrajectory* path) {
  for (TrajectoryPose& pose : path->poses) {
    pose.reference_from_camera.translation_m = pose.reference_from_camera.translation_m * factor;
  }
  for (TrajectoryPoint& point : path->points) point.place.xyz = point.place.xyz * factor;
}

}  // namespace pleinair::exports
