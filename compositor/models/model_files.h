#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"

namespace pleinair::compositor {

/// A file's whole content. Errors: missing, a folder, unreadable, larger than 4 GiB.
Result<std::string> ReadWholeFile(const std::filesystem::path& file);

}  // namespace pleinair::compositor
