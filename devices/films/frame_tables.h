#pragma once

#include <filesystem>

#include "base/error.h"

namespace pleinair::devices {

/// Checks that the tables in the header of an MP4 or MOV file agree on the number of frames. They
/// are sizes (`stsz`), durations (`stts`), and chunks (`stsc` with `stco` or `co64`). Source:
/// ISO/IEC 14496-12, 8.6 and 8.7. A player follows the shortest one without a word. Other
/// containers and fragmented files pass. Error (input): they disagree.
Result<void> CheckFrameTables(const std::filesystem::path& file);

}  // namespace pleinair::devices
