#include "app/replay/given_trajectory.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "devices/recordings/euroc.h"
#include "export/trajectories/place_pairs.h"
#include "export/trajectories/trajectory_files.h"
#include "files/text_file.h"

namespace pleinair::app {
namespace {

using exports::TrajectoryFormat;

/// The camera of the trajectory's images from that of the frames, which are turned clockwise.
Mat3 ImageFromFrame(int turn_deg) {
  switch (turn_deg) {
    case 90:
      return {{0, 1, 0, -1, 0, 0, 0, 0, 1}};
    case 180:
      return {{-1, 0, 0, 0, -1, 0, 0, 0, 1}};
    case 270:
      return {{0, -1, 0, 1, 0, 0, 0, 0, 1}};
    default:
      return {};
  }
}

Result<TrajectoryFormat> FormatOfTrajectory(const scene::TrajectoryDescription& description) {
  if (description.format.empty()) return exports::TrajectoryFormatToRead(description.file);
  if (const auto named = exports::TrajectoryFormatNamed(description.format)) return *named;
  return InputError(description.file.string(),
                    "has the unknown format \"" + description.format + "\"",
                    "known are tum, euroc, colmap, stray and record3d");
}

/// Errors: an image of a COLMAP model has no number.
Result<void> CheckNumbers(const exports::CameraTrajectory& path, const std::string& file) {
  for (const exports::TrajectoryPose& pose : path.poses) {
    if (pose.frame) continue;
    return InputError(file, "has images without numbers, which cannot be assigned to frames",
                      "name them by the numbers of their frames, from 0000.png");
  }
  return {};
}

}  // namespace

Result<exports::CameraTrajectory> ReadTrajectoryFile(
    const scene::TrajectoryDescription& description) {
  PLEINAIR_ASSIGN_OR_RETURN(const TrajectoryFormat format, FormatOfTrajectory(description));
  exports::TrajectoryReading reading;
  // Only the order of the times counts where frames are found by their numbers.
  reading.frame_rate_hz = description.frame_rate_hz.value_or(1.0);
  if (!description.extrinsics.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(
        const std::string yaml,
        files::ReadWholeFile(description.extrinsics, files::kMaxCalibrationBytes));
    PLEINAIR_ASSIGN_OR_RETURN(reading.body_from_camera,
                              devices::ParseEurocExtrinsics(yaml, description.extrinsics.string()));
  }
  return exports::ReadTrajectory(description.file, format, reading);
}

Result<session::TrajectoryRequest> ReadGivenTrajectory(
    const scene::TrajectoryDescription& description) {
  const std::string name = description.file.string();
  PLEINAIR_ASSIGN_OR_RETURN(const TrajectoryFormat format, FormatOfTrajectory(description));
  PLEINAIR_ASSIGN_OR_RETURN(exports::CameraTrajectory path, ReadTrajectoryFile(description));
  const bool is_colmap =
      format == TrajectoryFormat::kColmap || format == TrajectoryFormat::kColmapBinary;
  session::TrajectoryRequest request;
  session::GivenTrajectory& trajectory = request.trajectory;
  trajectory.file = name;
  trajectory.by_frame = is_colmap && !description.frame_rate_hz;
  if (trajectory.by_frame) PLEINAIR_RETURN_IF_ERROR(CheckNumbers(path, name));
  if (description.scale) exports::ScaleTrajectory(*description.scale, &path);
  trajectory.is_metric =
      !description.is_scale_free && (description.scale.has_value() || !is_colmap);
  trajectory.max_gap_s = description.max_gap_s.value_or(trajectory.max_gap_s);
  if (exports::IsArkit(format)) trajectory.up = Vec3{0, 1, 0};
  const Transform<Camera, Camera> turn{ImageFromFrame(description.turn_deg), {}};
  // The trajectory's frame of reference has another name in session.
  const Transform<session::TrajectoryWorld, exports::Reference> world_from_reference;
  trajectory.poses.reserve(path.poses.size());
  for (const exports::TrajectoryPose& pose : path.poses) {
    trajectory.poses.push_back(
        {pose.timestamp_ns, pose.frame, world_from_reference * pose.reference_from_camera * turn});
  }
  if (description.offset_s) {
    constexpr double kSecond_ns = 1e9;
    request.offset_ns = std::llround(*description.offset_s * kSecond_ns);
  }
  if (!description.points.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(
        const std::string text,
        files::ReadWholeFile(description.points, files::kMaxCalibrationBytes));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<exports::PlacePair> places,
                              exports::ParsePlacePairs(text, description.points.string()));
    // The file has them in the trajectory's own unit.
    const double scale = description.scale.value_or(1.0);
    for (const exports::PlacePair& place : places) {
      request.points.push_back({{place.in_trajectory.xyz * scale}, place.in_scene});
    }
  }
  return request;
}

Error OtherLensThanTrajectorys(Error error, const std::string& lens_from) {
  error.what += "; it is that of " + lens_from;
  error.remedy = "name the film that belongs to it, or give the film's lens with --calibration";
  return error;
}

std::optional<std::int64_t> ClockStartOf(const devices::Frame& first) {
  std::int64_t start_ns = 0;
  if (!first.device_timestamp_ns ||
      __builtin_sub_overflow(*first.device_timestamp_ns, first.timestamp_ns, &start_ns)) {
    return std::nullopt;
  }
  return start_ns;
}

}  // namespace pleinair::app
