#pragma once

#include <cstdint>
#include <vector>

#include "base/frames.h"

namespace pleinair {

/// Pose of the camera at one time.
struct TimedPose {
  /// Nanoseconds since the recording's start, or since the epoch of the source file (EuRoC: Unix
  /// epoch).
  std::int64_t timestamp_ns = 0;
  Transform<Marker, Camera> marker_from_camera;  ///< Metres.
};

/// Trajectory of a camera in the frame of the reference marker, ascending in time. Frames without a
/// pose are left out.
using Trajectory = std::vector<TimedPose>;

}  // namespace pleinair
