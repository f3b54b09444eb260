#pragma once

// Internal: between the .cc files of this module; not installed.

#include <vector>

#include "devices/cameras/camera.h"
#include "devices/cameras/v4l2/v4l2_node.h"

namespace pleinair::devices {

/// The four controls as far as the node has them.
std::vector<ControlRange> V4l2Controls(const V4l2Node& node);

/// Fulfils wishes one by one: the automatism off first (drivers refuse the value before), then the
/// value, then reads back.
std::vector<ControlResult> LockV4l2Controls(const V4l2Node& node,
                                            const std::vector<ControlRequest>& control_requests);

}  // namespace pleinair::devices
