#include "files/text_file.h"

#include <fstream>
#include <system_error>

namespace pleinair::files {

Result<std::string> ReadWholeFile(const std::filesystem::path& file, std::size_t max_bytes) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    return InputError(file.string(), "there is no such file", "check the name and the folder");
  }
  if (!std::filesystem::is_regular_file(status)) {
    return InputError(file.string(), "is not a file", "name a file");
  }
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
