#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <memory>

#include "devices/cameras/camera_device.h"

namespace pleinair::devices {

/// Errors: this build lacks the backend, or the URI names a file, which is not a camera.
Result<void> CheckBackend(const CameraUri& uri);

/// Opens a device and starts its stream; errors as in the backend.
Result<std::unique_ptr<CameraDevice>> OpenCameraDevice(const CameraUri& uri,
                                                       const FormatRequest& requested);

}  // namespace pleinair::devices
