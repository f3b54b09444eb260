#pragma once

// Internal: between the .cc files of this module; not installed.

#include <memory>
#include <vector>

#include "devices/cameras/camera_device.h"

namespace pleinair::devices {

/// Opens a GigE Vision or USB3 Vision camera by its name or serial number and starts its stream.
/// Looking for it sends a broadcast on every network interface.
/// Errors, in words: not there, another program controls it, no format that we read.
Result<std::unique_ptr<CameraDevice>> OpenAravisDevice(const CameraUri& uri,
                                                       const FormatRequest& requested);

/// Every camera that answers a broadcast on the networks, or is on USB.
Result<std::vector<CameraDescription>> ListAravisCameras();

}  // namespace pleinair::devices
