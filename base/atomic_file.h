#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/error.h"

namespace pleinair {

/// The error for a file that could not be written. A full disk is a system error (exit 1); a folder
/// without write permission is an input error (exit 2).
inline Error WriteError(const std::filesystem::path& path, int error_number) {
  const bool full = error_number == ENOSPC || error_number == EDQUOT || error_number == EFBIG;
  const bool system = full || error_number == EIO || error_number == ENOMEM;
  const std::string remedy = full     ? "free some space or choose another folder"
                             : system ? "try again or choose another folder"
                                      : "choose a folder that you may write to";
  return Error{system ? ErrorKind::kSystem : ErrorKind::kInput, path.string(),
               "cannot write: " + std::string(std::strerror(error_number)), remedy};
}

/// A temporary name in the folder of `path`, to be renamed to `path` when the file is complete. It
/// keeps the extension, because encoders choose the format by it.
inline std::filesystem::path TemporarySibling(const std::filesystem::path& path) {
  std::string name(1, '.');  // Built by +=: GCC 12 warns of "." + std::string (PR 105651).
  name += path.stem().string() + ".part" + std::to_string(getpid()) + path.extension().string();
  return path.parent_path() / name;
}

/// Renames a finished temporary file to its final name; removes it on failure.
inline Result<void> CommitFile(const std::filesystem::path& temporary,
                               const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    return tl::make_unexpected(WriteError(path, error.value()));
  }
  return {};
}

/// Writes a file under a temporary name, then renames it. Readers see the complete file or none.
inline Result<void> WriteFileAtomically(const std::filesystem::path& path,
                                        std::string_view content) {
  const std::filesystem::path temporary = TemporarySibling(path);
  errno = 0;
  {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) {
      const int error_number = errno != 0 ? errno : EIO;
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
      return tl::make_unexpected(WriteError(path, error_number));
    }
  }
  return CommitFile(temporary, path);
}

}  // namespace pleinair
