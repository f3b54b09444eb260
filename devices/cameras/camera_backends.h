#pragma once

// Internal: between the .cc files of this module; not installed.

#include <memory>

#include "devices/cameras/camera_device.h"

namespace pleinair::devices {

/// Error: this build has not got the backend, or the URI names a file, which is no camera.
Result<void> CheckBackend(const CameraUri& uri);

/// Opens a device and starts its stream; errors are the backend's.
Result<std::unique_ptr<CameraDevice>> OpenCameraDevice(const CameraUri& uri,
                                                       const FormatRequest& requested);

}  // namespace pleinair::devices
