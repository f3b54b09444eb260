#include "compositor/models/model_files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "compositor/models/model_limits.h"

namespace pleinair::compositor {

Result<std::string> ReadWholeFile(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    return InputError(file.string(), "does not exist", "check the name");
  }
  if (!std::filesystem::is_regular_file(status)) {
    return InputError(file.string(), "is not a file", "name the model's file");
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) return InputError(file.string(), "cannot be read: " + error.message());
  if (size > kMaxFileBytes) {
    return InputError(file.string(), "is larger than 4 GiB", "use a simpler model");
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (!stream && size > 0) {
    const std::string cause = errno != 0 ? std::strerror(errno) : "it changed meanwhile";
    return InputError(file.string(), "cannot be read: " + cause, "check its permissions");
  }
  return content;
}

}  // namespace pleinair::compositor
