#pragma once

#include <functional>

#include "base/frames.h"

namespace pleinair::compositor {

/// Pose of the camera at a share of a frame's exposure, −½…½. At 0 it is the pose of the frame,
/// whatever moment the time stamp means: a marker's blurred edges are found at their middle. Empty:
/// the camera stands still.
using CameraMotion = std::function<Transform<Camera, Marker>(double share)>;

}  // namespace pleinair::compositor
