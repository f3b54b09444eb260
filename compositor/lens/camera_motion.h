#pragma once

#include <functional>

#include "base/frames.h"

namespace pleinair::compositor {

/// Pose of the camera at a share of a frame's exposure, −½…½. At 0 it is the pose of the frame: a
/// marker's edges that are blurred by motion are found at their middle, whatever moment the frame's
/// time stamp means. Empty: the camera stands still.
using CameraMotion = std::function<Transform<Camera, Marker>(double share)>;

}  // namespace pleinair::compositor
