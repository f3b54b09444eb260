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

/// What a path's poses are told in: the marker's frame for paths of pleinair's, whatever its author
/// chose for others. Right-handed; metres where the author knows the scale.
struct Reference;

struct TrajectoryPose {
  std::int64_t timestamp_ns = 0;
  Transform<Reference, Camera> reference_from_camera;
  std::string picture;  ///< File name of the frame; empty where nobody said.
};

/// A place that a reconstruction knows.
struct TrajectoryPoint {
  Point<Reference> place;
  std::array<std::uint8_t, 3> rgb{};  ///< sRGB codes.
  double error_px = 0.0;              ///< Mean reprojection error; negative where unknown.
};

/// Where a camera was, moment by moment.
struct CameraTrajectory {
  std::vector<TrajectoryPose> poses;  ///< Times ascend.
  std::optional<CameraModel> camera;  ///< Where the file says, or the user.
  std::vector<TrajectoryPoint> points;
};

/// Checks a pose that a line of a file tells; `where` is the line's. Errors: a quaternion whose
/// length is not 1 to 1 % (zero, or a number cut short), a shift of more than 1e9.
Result<void> CheckPose(const std::string& where, Vec3 shift, const Quaternion& turn);

/// The checked pose.
template <typename To, typename From>
Result<Transform<To, From>> PoseFromFile(const std::string& where, Vec3 shift,
                                         const Quaternion& turn) {
  PLEINAIR_RETURN_IF_ERROR(CheckPose(where, shift, turn));
  return Transform<To, From>{RotationOf(turn), shift};
}

/// Adds a pose of a file whose lines ascend in time. Errors: it is not later than the last, or
/// centuries away.
Result<void> AddPose(const std::string& where, TrajectoryPose pose, CameraTrajectory* path);

/// Multiplies all lengths: reconstructions know no scale of their own.
void ScaleTrajectory(double factor, CameraTrajectory* path);

}  // namespace pleinair::exports
