#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// The observations in a frame, as a line of detections.jsonl.
struct MarkersMessage {
  std::int64_t timestamp_ns = 0;
  std::string json;
};

struct McapTrajectoryOptions {
  std::string reference = "marker";     ///< Name of the trajectory's reference.
  std::int64_t start_ns = 0;            ///< Unix time of the trajectory's time zero.
  double marker_size_m = 0.0;           ///< Drawn at the reference's origin; 0: none.
  std::vector<MarkersMessage> markers;  ///< Times ascend.
};

/// Writes the trajectory as an MCAP file of JSON messages. The channels are `/camera/calibration`
/// (foxglove.CameraCalibration), `/tf` (foxglove.FrameTransform), `/camera/pose`
/// (foxglove.PoseInFrame), `/scene` (foxglove.SceneUpdate: the marker) and `/markers`
/// (pleinair.Markers). Channels without data are omitted. Errors: a time before 1970.
Result<std::string> McapFromTrajectory(const CameraTrajectory& path,
                                       const McapTrajectoryOptions& options);

}  // namespace pleinair::exports
