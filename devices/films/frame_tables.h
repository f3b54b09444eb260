#pragma once

#include <filesystem>

#include "base/error.h"

namespace pleinair::devices {

/// Checks that the tables in the header of an MP4 or MOV file agree on the number of frames. These
/// are sizes (`stsz`), durations (`stts`), and chunks (`stsc` with `stco` or `co64`). Decoders
/// silently stop at the shortest table. Source: ISO/IEC 14496-12, 8.6 and 8.7. Other containers and
/// fragmented files pass. Error (input): the tables disagree.
Result<void> CheckFrameTables(const std::filesystem::path& file);

}  // namespace pleinair::devices
