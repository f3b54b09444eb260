#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"

namespace pleinair::exports {

/// Size limit of Record3D's metadata. An hour at 60 Hz has some 100 MB. The parsed JSON takes
/// several times as much memory.
constexpr std::size_t kMaxRecord3dMetadata_bytes = std::size_t{1} << 28;

/// True for a regular file that begins as a zip archive does ("PK", APPNOTE.TXT 6.3.10, 4.3.7).
bool IsZipArchive(const std::filesystem::path& file);

/// Returns the file `metadata` of an .r3d archive, the zip archive that Record3D shares: the input
/// of ParseRecord3dMetadata(). Nothing is written to the disk, and no other file of the archive is
/// read. Errors: no archive, a cut or damaged one, no `metadata` in it, an encrypted one. Also one
/// of more than kMaxRecord3dMetadata_bytes, or of more than 1 MiB that is 100 times as large as its
/// compressed bytes. `file` must be a regular file.
Result<std::string> ReadRecord3dArchive(const std::filesystem::path& file);

/// The same of an archive in memory. `name`: for messages.
Result<std::string> ParseRecord3dArchive(std::string_view bytes, const std::string& name);

}  // namespace pleinair::exports
