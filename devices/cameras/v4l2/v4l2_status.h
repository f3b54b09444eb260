#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>
#include <optional>
#include <string>

#include "base/error.h"
#include "devices/images/raw_image.h"

namespace pleinair::devices {

/// The error of a system call on a node that failed with `error_number` (positive).
Error V4l2Error(const std::string& node, const std::string& doing, int error_number);

/// V4L2's code of one of our formats, and back; JPEG maps to MJPG. Nullopt: not supported.
std::uint32_t FourCcOf(PixelFormat format);
std::optional<PixelFormat> PixelFormatOf(std::uint32_t four_cc);

/// Printable name of a code: "YUYV", "Y16 " without the space; unprintable bytes as dots.
std::string FourCcName(std::uint32_t four_cc);

}  // namespace pleinair::devices
