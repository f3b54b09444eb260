#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "export/trajectories/camera_trajectory.h"

namespace pleinair::app {

/// Where a recording's camera was, by somebody who knows.
struct RecordingTruth {
  std::vector<exports::TrajectoryPose> poses;  ///< Times as the file has them.
  /// The reference is the marker (truth.tum); else it is a frame of the author's own, such as a
  /// motion capture system's.
  bool in_marker_frame = true;
};

/// Reads what a recording's folder has, in this order: truth.tum (the camera in the marker's
/// frame); groundtruth.txt, the TUM RGB-D benchmark's name for the camera in a frame of its own;
/// the EuRoC data sets' state_groundtruth_estimate0/data.csv beside cam0 (the body in a frame of
/// its own; T_BS of cam0/sensor.yaml makes it the camera's). Errors (input): there is none, or it
/// cannot be read.
Result<RecordingTruth> ReadRecordingTruth(const std::filesystem::path& recording);

/// The pose of a moment: between its neighbours (shift and quaternion linearly) where both lie
/// within a frame period, else that of a neighbour within a quarter of a period; nothing without
/// such.
std::optional<Transform<exports::Reference, Camera>> PoseAt(
    const std::vector<exports::TrajectoryPose>& poses, std::int64_t timestamp_ns,
    std::int64_t period_ns);

/// How a frame of reference lies in the marker's, by what a detector found: the mean over the
/// moments, without those whose rotation is off by more than three times the median (poses that
/// flipped). Nothing without any.
struct PosePair {
  Transform<Marker, Camera> found;
  Transform<exports::Reference, Camera> truth;
};
std::optional<Transform<Marker, exports::Reference>> AlignReference(
    const std::vector<PosePair>& pairs);

}  // namespace pleinair::app
