#pragma once

// Internal: not installed.

#include <cstddef>
#include <functional>
#include <vector>

#include "base/frames.h"
#include "session/marker_tracks.h"

namespace pleinair::session {

/// Pose of the camera some seconds after that of a frame; negative: before it.
using PoseMotion = std::function<Transform<Camera, Marker>(double seconds)>;

/// The motion about a pose of a path (PathMotion), for a fraction of the time to its neighbours. At
/// the path's end the motion from the pose before goes on. Empty where the neighbours are farther
/// than kMaxGap_s, or turn faster than cameras do: a marker's tilt was then mistaken.
PoseMotion MotionAbout(const std::vector<Observation>& path, std::size_t index);

/// The same motion of the camera about another estimate of the pose. Empty without a motion.
PoseMotion MovedTo(const PoseMotion& motion, const Transform<Camera, Marker>& camera_from_marker);

}  // namespace pleinair::session
