#pragma once

// Internal: between the .cc files of this module; not installed.

#include <libcamera/camera.h>
#include <libcamera/camera_manager.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "devices/cameras/camera.h"
#include "devices/cameras/v4l2/v4l2_node.h"

namespace pleinair::devices {

/// The process's one manager (libcamera allows no second), started when needed and stopped with
/// the last reference, after everything that came from it. It knows the cameras that were plugged
/// in when it started and does not notice what comes and goes: KernelEntryOf() tells of a camera
/// that left, a new manager of one that came. Error (system): it cannot be started.
Result<std::shared_ptr<libcamera::CameraManager>> LibcameraManager();

/// Formats of a camera's first stream for viewing, largest size first; libcamera states no rates.
std::vector<FormatDescription> LibcameraFormats(const libcamera::StreamFormats& formats);

std::optional<PixelFormat> PixelFormatOf(const libcamera::PixelFormat& theirs);
std::optional<libcamera::PixelFormat> LibcameraFormatOf(PixelFormat ours);

/// The video node behind a camera whose pictures come straight from one (USB cameras), for the
/// controls that libcamera has not; nothing for cameras with a pipeline of several.
std::optional<V4l2Node> NodeBehind(libcamera::CameraManager& manager,
                                   const std::shared_ptr<libcamera::Camera>& camera);

/// A path that exists as long as the camera is plugged in, though its nodes be held open; nothing
/// where no video node of it is known.
std::optional<std::string> KernelEntryOf(libcamera::CameraManager& manager,
                                         const std::shared_ptr<libcamera::Camera>& camera);

}  // namespace pleinair::devices
