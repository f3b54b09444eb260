#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <memory>

#include "devices/cameras/camera_device.h"
#include "devices/cameras/v4l2/v4l2_io.h"

namespace pleinair::devices {

/// Opens the camera that `uri` identifies now, negotiates the format and starts the stream. Errors:
/// not found, no permission, busy, too little bandwidth, no supported pixel format, a format that
/// the camera does not have.
Result<std::unique_ptr<CameraDevice>> OpenV4l2Device(const std::shared_ptr<V4l2Io>& io,
                                                     const CameraUri& uri,
                                                     const FormatRequest& requested);

}  // namespace pleinair::devices
