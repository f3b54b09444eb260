#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"
#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

/// A target file as docs/guide/reference/recordings.md describes it: version, length and checksum
/// before the content. Files that a later version wrote are refused.
inline constexpr int kTargetFileVersion = 1;

/// The bytes of a target file; reading them gives the same target.
std::string SerializeTarget(const PictureTarget& target);

/// Reads what SerializeTarget wrote. `name` is what errors call it.
/// Errors (input): no target file, of another version, cut short or damaged, values that no target
/// has. Whatever the bytes are, no more memory is taken than some times their number.
Result<PictureTarget> ParseTarget(std::string_view bytes, const std::string& name);

/// Writes a target file under a temporary name, then renames it.
Result<void> WriteTargetFile(const PictureTarget& target, const std::filesystem::path& file);
Result<PictureTarget> ReadTargetFile(const std::filesystem::path& file);

/// CRC-32 of IEEE 802.3 (zlib's, PNG's).
std::uint32_t Crc32(std::string_view bytes);

}  // namespace pleinair::tracker
