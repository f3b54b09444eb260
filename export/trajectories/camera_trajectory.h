#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/quaternion.h"

namespace pleinair::exports {

/// Frame of reference of a trajectory: the marker's frame for our trajectories, the author's choice
/// for others. Right-handed; metres if the author knows the scale.
struct Reference;

struct TrajectoryPose {
  std::int64_t timestamp_ns = 0;
  Transform<Reference, Camera> reference_from_camera;
  std::string picture;                  ///< File name of the frame; empty if unknown.
  std::optional<std::int64_t> frame{};  ///< Number of the frame in its film, if known.
};

/// A reconstructed point.
struct TrajectoryPoint {
  Point<Reference> place;
  std::array<std::uint8_t, 3> rgb{};  ///< 8-bit sRGB values.
  double error_px = 0.0;              ///< Mean reprojection error; negative if unknown.
};

/// A camera's poses over time.
struct CameraTrajectory {
  std::vector<TrajectoryPose> poses;  ///< Times ascend.
  std::optional<CameraModel> camera;  ///< From the file or the user.
  std::vector<TrajectoryPoint> points;
};

/// Checks a pose of a line in a file; `where` is the line's location. Errors: a quaternion whose
/// length differs from 1 by more than 1 % (zero, or truncated numbers), a translation of more than
/// 1e9.
Result<void> CheckPose(const std::string& where, Vec3 shift, const Quaternion& turn);

/// Returns the checked pose.
template <typename To, typename From>
Result<Transform<To, From>> PoseFromFile(const std::string& where, Vec3 shift,
                                         const Quaternion& turn) {
  PLEINAIR_RETURN_IF_ERROR(CheckPose(where, shift, turn));
  return Transform<To, From>{RotationOf(turn), shift};
}

/// Adds a pose of a file whose lines ascend in time. Errors: it is not later than the last, or
/// centuries away.
Result<void> AddPose(const std::string& where, TrajectoryPose pose, CameraTrajectory* path);

/// Multiplies all lengths: reconstructions have no absolute scale.
void ScaleTrajectory(double factor, CameraTrajectory* path);

}  // namespace pleinair::exports
