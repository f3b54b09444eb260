#pragma once

// Internal: between the .cc files of this module; not installed.

#include <libcamera/controls.h>

#include <optional>
#include <vector>

#include "devices/cameras/camera.h"

namespace pleinair::devices {

/// The four controls as far as libcamera itself has them. Their present values are not known before
/// the first image: the default stands in for them.
std::vector<ControlRange> LibcameraControls(const libcamera::ControlInfoMap& infos);

/// Puts one wish into `request`, for the next image. Nothing where libcamera has no such control.
/// A present value that is to be held is `now`.
std::optional<ControlResult> RequestLibcameraControl(const libcamera::ControlInfoMap& infos,
                                                     const ControlRequest& requested,
                                                     std::optional<double> now,
                                                     libcamera::ControlList* request);

}  // namespace pleinair::devices
