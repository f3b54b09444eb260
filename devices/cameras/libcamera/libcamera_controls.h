#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <libcamera/controls.h>

#include <optional>
#include <vector>

#include "devices/cameras/camera.h"

namespace pleinair::devices {

/// Those of the four controls that libcamera itself has. Their present values are unknown before
/// the first image, so the defaults are reported.
std::vector<ControlRange> LibcameraControls(const libcamera::ControlInfoMap& infos);

/// Adds one control request to `request`, for the next image. Returns nullopt if libcamera lacks
/// the control. `now` is the present value, used when it is to be locked.
std::optional<ControlResult> RequestLibcameraControl(const libcamera::ControlInfoMap& infos,
                                                     const ControlRequest& requested,
                                                     std::optional<double> now,
                                                     libcamera::ControlList* request);

}  // namespace pleinair::devices
