#include "session/trajectory/given_trajectory.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "session/trajectory/alignment_numbers.h"

namespace pleinair::session {
namespace {

Eigen::Quaterniond EigenQuaternion(const Mat3& rotation) {
  return Eigen::Quaterniond(EigenOf(rotation));
}

}  // namespace

std::optional<Transform<TrajectoryWorld, Camera>> PoseAtTime(const GivenTrajectory& trajectory,
                                                             std::int64_t timestamp_ns) {
  constexpr double kSecond_ns = 1e9;
  const std::vector<GivenPose>& poses = trajectory.poses;
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), timestamp_ns,
      [](const GivenPose& pose, std::int64_t time_ns) { return pose.timestamp_ns < time_ns; });
  // Stamps in files are rounded.
  constexpr std::int64_t kRounding_ns = 1'000'000;
  const auto is_at = [&](const GivenPose& pose) {
    std::int64_t difference_ns = 0;
    return !__builtin_sub_overflow(timestamp_ns, pose.timestamp_ns, &difference_ns) &&
           difference_ns >= -kRounding_ns && difference_ns <= kRounding_ns;
  };
  if (after == poses.end()) {
    if (poses.empty() || !is_at(poses.back())) return std::nullopt;
    return poses.back().world_from_camera;
  }
  if (after->timestamp_ns == timestamp_ns) return after->world_from_camera;
  if (after == poses.begin()) {
    if (!is_at(poses.front())) return std::nullopt;
    return poses.front().world_from_camera;
  }
  const GivenPose& before = *(after - 1);
  // As doubles: the difference of two times may exceed 64 bits.
  const double length_ns =
      static_cast<double>(after->timestamp_ns) - static_cast<double>(before.timestamp_ns);
  if (!(length_ns > 0.0 && length_ns <= trajectory.max_gap_s * kSecond_ns)) {
    if (is_at(before)) return before.world_from_camera;
    if (is_at(*after)) return after->world_from_camera;
    return std::nullopt;
  }
  const double share = static_cast<double>(timestamp_ns - before.timestamp_ns) / length_ns;
  const Transform<TrajectoryWorld, Camera>& a = before.world_from_camera;
  const Transform<TrajectoryWorld, Camera>& b = after->world_from_camera;
  Transform<TrajectoryWorld, Camera> pose;
  pose.rotation = MatOf(
      EigenQuaternion(a.rotation).slerp(share, EigenQuaternion(b.rotation)).toRotationMatrix());
  pose.translation_m = a.translation_m * (1.0 - share) + b.translation_m * share;
  return pose;
}

std::optional<Transform<TrajectoryWorld, Camera>> PoseOfFrame(const GivenTrajectory& trajectory,
                                                              std::int64_t frame_index) {
  const auto found = std::lower_bound(
      trajectory.poses.begin(), trajectory.poses.end(), frame_index,
      [](const GivenPose& pose, std::int64_t index) { return pose.frame_index < index; });
  if (found == trajectory.poses.end() || found->frame_index != frame_index) return std::nullopt;
  return found->world_from_camera;
}

std::optional<Transform<TrajectoryWorld, Camera>> PoseIn(const GivenTrajectory& trajectory,
                                                         std::int64_t frame_index,
                                                         std::int64_t timestamp_ns,
                                                         std::int64_t offset_ns) {
  if (trajectory.by_frame) return PoseOfFrame(trajectory, frame_index);
  std::int64_t time_ns = 0;
  if (__builtin_sub_overflow(timestamp_ns, offset_ns, &time_ns)) return std::nullopt;
  return PoseAtTime(trajectory, time_ns);
}

}  // namespace pleinair::session
