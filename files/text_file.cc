#include "files/text_file.h"

#include <fstream>
#include <system_error>

namespace pleinair::files {

Result<void> CheckRegularFile(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error, ignored;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_regular_file(status)) return {};
  const auto fail = [&](const std::string& what) {
    return InputError(file.string(), what, "name a file");
  };
  if (error == std::errc::too_many_symbolic_link_levels) return fail("is a link to itself");
  if (error == std::errc::permission_denied) {
    return InputError(file.string(), "cannot be read: " + error.message(),
                      "check the permissions of its folders");
  }
  if (!fs::exists(status)) {
    if (fs::is_symlink(fs::symlink_status(file, ignored))) return fail("is a link to nothing");
    return InputError(file.string(), "there is no such file", "check the name and the folder");
  }
  return fail(fs::is_directory(status) ? "is a folder, not a file"
              : fs::is_fifo(status)    ? "is a pipe, not a file"
                                       : "is a device, not a file");
}

Result<std::string> ReadWholeFile(const std::filesystem::path& file, std::size_t max_bytes) {
  PLEINAIR_RETURN_IF_ERROR(CheckRegularFile(file));
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) return InputError(file.string(), "cannot be read: " + error.message());
  if (size == 0) return InputError(file.string(), "is empty", "get a whole copy of it");
  if (size > max_bytes) {
    return InputError(file.string(),
                      "has " + std::to_string(size) + " bytes, more than the " +
                          std::to_string(max_bytes) + " that such a file may have",
                      "check that it is the file you mean");
  }
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) {
    return InputError(file.string(), "cannot be read to its end",
                      "check its permissions and the disk");
  }
  return bytes;
}

}  // namespace pleinair::files
