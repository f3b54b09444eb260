#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"
#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

/// Version of the target file format (docs/guide/reference/recordings.md): version, length and
/// checksum before the content. Files of later versions are rejected.
inline constexpr int kTargetFileVersion = 1;

/// Content of a target file; parsing it gives an equal target.
std::string SerializeTarget(const PictureTarget& target);

/// Parses the content of a target file. `name` is the file's name in messages. Errors (input): not
/// a target file, another version, truncated or damaged, invalid values. Memory use is proportional
/// to the number of bytes, whatever they contain.
Result<PictureTarget> ParseTarget(std::string_view bytes, const std::string& name);

/// Writes a target file under a temporary name, then renames it.
Result<void> WriteTargetFile(const PictureTarget& target, const std::filesystem::path& file);
Result<PictureTarget> ReadTargetFile(const std::filesystem::path& file);

/// CRC-32 of IEEE 802.3 (zlib's, PNG's).
std::uint32_t Crc32(std::string_view bytes);

}  // namespace pleinair::tracker
