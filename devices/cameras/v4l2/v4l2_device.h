#pragma once

// Internal: between the .cc files of this module; not installed.

#include <memory>

#include "devices/cameras/camera_device.h"
#include "devices/cameras/v4l2/v4l2_io.h"

namespace pleinair::devices {

/// Opens the camera that `uri` means now, agrees on pictures and starts the stream.
/// Errors, in words: not there, no permission, busy, too little bandwidth, no format that we read,
/// a format that the camera does not have.
Result<std::unique_ptr<CameraDevice>> OpenV4l2Device(const std::shared_ptr<V4l2Io>& io,
                                                     const CameraUri& uri,
                                                     const FormatRequest& requested);

}  // namespace pleinair::devices
