#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

#include "devices/cameras/camera.h"
#include "devices/cameras/v4l2/v4l2_node.h"

namespace pleinair::devices {

/// Those of the four controls that the node has.
std::vector<ControlRange> V4l2Controls(const V4l2Node& node);

/// Applies control requests in order. For each it turns automatic control off (drivers reject a
/// value before), sets the value, then reads it back.
std::vector<ControlResult> LockV4l2Controls(const V4l2Node& node,
                                            const std::vector<ControlRequest>& control_requests);

}  // namespace pleinair::devices
