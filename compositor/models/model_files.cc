#include "compositor/models/model_files.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "compositor/models/model_limits.h"

namespace pleinair::compositor {
namespace {

std::atomic<bool> files_outside_allowed{false};

}  // namespace

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

void AllowFilesOutsideModels(bool allowed) { files_outside_allowed = allowed; }

Result<void> CheckBelongsToModel(const std::filesystem::path& file,
                                 const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const std::string name = file.string();
  if (name.find('\0') != std::string::npos) {
    return InputError(name.substr(0, name.find('\0')), "is a file name with a NUL inside",
                      "repair the model or export it again");
  }
  if (files_outside_allowed) return {};
  std::error_code error;
  const fs::path root = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
  const fs::path real = fs::weakly_canonical(file, error);
  if (!error &&
      std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end()) {
    return {};
  }
  return InputError(name, "lies outside the folder of the model that names it",
                    "put it beside the model, or trust the model with --allow-outside");
}

}  // namespace pleinair::compositor
