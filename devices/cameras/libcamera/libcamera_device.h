#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <memory>
#include <vector>

#include "devices/cameras/camera_device.h"

namespace pleinair::devices {

/// Opens a camera by libcamera's name, or by its index in libcamera's list ("0"), and starts its
/// stream. Errors: not found, used by another program, no supported pixel format.
Result<std::unique_ptr<CameraDevice>> OpenLibcameraDevice(const CameraUri& uri,
                                                          const FormatRequest& requested);

/// Lists the cameras that libcamera supports. Error: libcamera cannot be started.
Result<std::vector<CameraDescription>> ListLibcameraCameras();

}  // namespace pleinair::devices
