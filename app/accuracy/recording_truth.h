#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "export/trajectories/camera_trajectory.h"

namespace pleinair::app {

/// Ground-truth trajectory of a recording's camera.
struct RecordingTruth {
  std::vector<exports::TrajectoryPose> poses;  ///< Times as in the file.
  /// True if the frame of reference is the marker (truth.tum). Otherwise it is the author's own,
  /// such as that of a motion capture system.
  bool in_marker_frame = true;
};

/// Reads the ground truth in a recording's folder. The first file found counts:
/// - truth.tum: the camera in the marker's frame;
/// - groundtruth.txt: the camera in another frame, as in the TUM RGB-D benchmark;
/// - state_groundtruth_estimate0/data.csv beside cam0, as in the EuRoC data sets: the body in
/// another frame. T_BS of cam0/sensor.yaml converts it to the camera.
/// Errors (input): there is none, or it cannot be read.
Result<RecordingTruth> ReadRecordingTruth(const std::filesystem::path& recording);

/// Interpolates the pose at a time. If both neighbours are within a frame period, it interpolates
/// translation and quaternion linearly. Otherwise it takes a neighbour within a quarter of a
/// period. Nothing if there is none.
std::optional<Transform<exports::Reference, Camera>> PoseAt(
    const std::vector<exports::TrajectoryPose>& poses, std::int64_t timestamp_ns,
    std::int64_t period_ns);

/// Aligns a frame of reference with the marker's frame from detected poses: the mean over all
/// times. Poses whose rotation error exceeds three times the median (flipped poses) are excluded.
/// Nothing without pairs.
struct PosePair {
  Transform<Marker, Camera> found;
  Transform<exports::Reference, Camera> truth;
};
std::optional<Transform<Marker, exports::Reference>> AlignReference(
    const std::vector<PosePair>& pairs);

}  // namespace pleinair::app
