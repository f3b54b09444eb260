#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstdint>
#include <optional>
#include <string>

#include "base/error.h"
#include "devices/images/raw_image.h"

namespace pleinair::devices {

/// The error for a system call on a node that gave `error_number` (positive), in words.
Error V4l2Error(const std::string& node, const std::string& doing, int error_number);

/// V4L2's number for our format and back; JPEG counts as MJPG. Nothing: we cannot read it.
std::uint32_t FourCcOf(PixelFormat format);
std::optional<PixelFormat> PixelFormatOf(std::uint32_t four_cc);

/// "YUYV", "Y16 " without the space; odd bytes as dots.
std::string FourCcName(std::uint32_t four_cc);

}  // namespace pleinair::devices
