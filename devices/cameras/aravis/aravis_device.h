#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <memory>
#include <vector>

#include "devices/cameras/camera_device.h"

namespace pleinair::devices {

/// Opens a GigE Vision or USB3 Vision camera by its name or serial number and starts its stream.
/// The discovery sends a broadcast on every network interface. Errors: not found, controlled by
/// another program, no supported pixel format.
Result<std::unique_ptr<CameraDevice>> OpenAravisDevice(const CameraUri& uri,
                                                       const FormatRequest& requested);

/// Lists the cameras that answer a broadcast on the networks or are connected by USB.
Result<std::vector<CameraDescription>> ListAravisCameras();

}  // namespace pleinair::devices
