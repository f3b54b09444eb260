#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"

namespace pleinair::exports {

/// True for a file that begins as a zip archive does ("PK", APPNOTE.TXT 6.3.10, 4.3.7).
bool IsZipArchive(const std::filesystem::path& file);

/// Returns the file `metadata` of an .r3d archive, the zip archive that Record3D shares: the input
/// of ParseRecord3dMetadata(). Nothing is written to the disk, and no other file of the archive is
/// read. Errors: no archive, a cut or damaged one, no `metadata` in it, an encrypted one. Also one
/// of more than 256 MiB, or of more than 1 MiB that is 100 times as large as its compressed bytes.
Result<std::string> ReadRecord3dArchive(const std::filesystem::path& file);

/// The same of an archive in memory. `name`: for messages.
Result<std::string> ParseRecord3dArchive(std::string_view bytes, const std::string& name);

}  // namespace pleinair::exports
