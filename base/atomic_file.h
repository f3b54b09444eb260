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

/// The file that writing to `path` reaches: the end of its symbolic links, which need not exist. A
/// link stays a link, and the file that it names is written.
inline std::filesystem::path EndOfLinks(std::filesystem::path path) {
  constexpr int kMaxLinks = 40;  // As Linux follows.
  std::error_code error;
  for (int i = 0; i < kMaxLinks && std::filesystem::is_symlink(path, error); ++i) {
    const std::filesystem::path target = std::filesystem::read_symlink(path, error);
    if (error) break;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

/// True for a device, pipe or socket, which is written directly.
inline bool IsDevice(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// A temporary name in the folder of the file that `path` names, to be renamed when the file is
/// complete. It keeps the extension, because encoders choose the format by it.
inline std::filesystem::path TemporarySibling(const std::filesystem::path& path) {
  std::string name(1, '.');  // Built by +=: GCC 12 warns of "." + std::string (PR 105651).
  name += path.stem().string() + ".part" + std::to_string(getpid()) + path.extension().string();
  return EndOfLinks(path).parent_path() / name;
}

/// Renames a finished temporary file to its final name; removes it on failure. A link at `path`
/// stays, and the file that it names is replaced.
inline Result<void> CommitFile(const std::filesystem::path& temporary,
                               const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::rename(temporary, EndOfLinks(path), error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    return tl::make_unexpected(WriteError(path, error.value()));
  }
  return {};
}

/// Writes a file under a temporary name, then renames it. Readers see the complete file or none. A
/// device or pipe is written directly.
inline Result<void> WriteFileAtomically(const std::filesystem::path& path,
                                        std::string_view content) {
  const bool device = IsDevice(path);
  const std::filesystem::path temporary = device ? path : TemporarySibling(path);
  errno = 0;
  {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) {
      const int error_number = errno != 0 ? errno : EIO;
      std::error_code ignored;
      if (!device) std::filesystem::remove(temporary, ignored);
      return tl::make_unexpected(WriteError(path, error_number));
    }
  }
  return device ? Result<void>() : CommitFile(temporary, path);
}

}  // namespace pleinair
