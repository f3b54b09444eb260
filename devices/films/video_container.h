#pragma once

#include <filesystem>

#include "base/error.h"

namespace pleinair::devices {

/// Checks whether a video file is truncated, without decoding, from the lengths in its container:
/// the boxes of MP4 and MOV (ISO/IEC 14496-12, 4.2), the RIFF chunk of AVI, or the segment of
/// Matroska and WebM (RFC 9559). Other containers pass. Error: the file is truncated.
Result<void> CheckContainerIsWhole(const std::filesystem::path& file);

}  // namespace pleinair::devices
