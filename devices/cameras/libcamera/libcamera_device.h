#pragma once

// Internal: between the .cc files of this module; not installed.

#include <memory>
#include <vector>

#include "devices/cameras/camera_device.h"

namespace pleinair::devices {

/// Opens a camera by libcamera's name for it, or by its place in libcamera's list ("0"), and starts
/// its stream. Errors, in words: not there, another program uses it, no format that we read.
Result<std::unique_ptr<CameraDevice>> OpenLibcameraDevice(const CameraUri& uri,
                                                          const FormatRequest& requested);

/// Every camera that libcamera knows. Error: it cannot be started.
Result<std::vector<CameraDescription>> ListLibcameraCameras();

}  // namespace pleinair::devices
