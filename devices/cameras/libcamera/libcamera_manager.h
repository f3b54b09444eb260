#pragma once

// Internal: shared by the .cc files of this module; not installed.

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

/// The process's only manager (libcamera allows one). It is started when needed and stopped with
/// its last reference, which must be released after everything obtained from it. It has the cameras
/// that were connected when it started and does not follow changes: use KernelEntryOf() to detect a
/// camera that was removed, and a new manager to find one that was added. Error (system): it cannot
/// be started.
Result<std::shared_ptr<libcamera::CameraManager>> LibcameraManager();

/// Formats of a camera's first viewfinder stream, largest size first. libcamera reports no frame
/// rates.
std::vector<FormatDescription> LibcameraFormats(const libcamera::StreamFormats& formats);

std::optional<PixelFormat> PixelFormatOf(const libcamera::PixelFormat& theirs);
std::optional<libcamera::PixelFormat> LibcameraFormatOf(PixelFormat ours);

/// The video node of a camera whose images come from a single node (USB cameras), for the controls
/// that libcamera lacks. Nullopt for cameras with a pipeline of several nodes.
std::optional<V4l2Node> NodeBehind(libcamera::CameraManager& manager,
                                   const std::shared_ptr<libcamera::Camera>& camera);

/// A path that exists as long as the camera is connected, even while its nodes are held open.
/// Nullopt if no video node of the camera is known.
std::optional<std::string> KernelEntryOf(libcamera::CameraManager& manager,
                                         const std::shared_ptr<libcamera::Camera>& camera);

}  // namespace pleinair::devices
