#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// What was seen in a frame, as a line of detections.jsonl.
struct MarkersMessage {
  std::int64_t timestamp_ns = 0;
  std::string json;
};

struct McapTrajectoryOptions {
  std::string reference = "marker";     ///< Name of the path's reference.
  std::int64_t start_ns = 0;            ///< Unix time that the path's own times count from.
  double marker_size_m = 0.0;           ///< Shown at the reference's origin; 0: none.
  std::vector<MarkersMessage> markers;  ///< Times ascend.
};

/// The path as an MCAP file of JSON messages: `/camera/calibration` (foxglove.CameraCalibration),
/// `/tf` (foxglove.FrameTransform), `/camera/pose` (foxglove.PoseInFrame), `/scene`
/// (foxglove.SceneUpdate: the marker's print) and `/markers` (pleinair.Markers), those of them that
/// there is something for. Errors: a time before 1970.
Result<std::string> McapFromTrajectory(const CameraTrajectory& path,
                                       const McapTrajectoryOptions& options);

}  // namespace pleinair::exports
