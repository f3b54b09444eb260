#pragma once

#include <filesystem>

#include "base/error.h"

namespace pleinair::devices {

/// Tells from a container's own lengths whether the file ends too early, without decoding: the
/// boxes of MP4 and MOV (ISO/IEC 14496-12, 4.2) and the RIFF chunk of AVI. Other containers pass.
/// Error: the file is cut short.
Result<void> CheckContainerIsWhole(const std::filesystem::path& file);

}  // namespace pleinair::devices
