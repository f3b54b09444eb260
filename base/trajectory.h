#pragma once

#include <cstdint>
#include <vector>

#include "base/frames.h"

namespace pleinair {

/// Where the camera was at one moment.
struct TimedPose {
  /// Nanoseconds since the recording's start, or since whatever the file that it came from counts
  /// from (EuRoC: the epoch).
  std::int64_t timestamp_ns = 0;
  Transform<Marker, Camera> marker_from_camera;  ///< Metres.
};

/// A camera's path in the frame of the marker that anchors the scene, ascending in time. Moments
/// without a pose are left out.
using Trajectory = std::vector<TimedPose>;

}  // namespace pleinair
