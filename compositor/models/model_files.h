#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"

namespace pleinair::compositor {

/// A file's whole content. Errors: missing, a folder, unreadable, larger than 4 GiB.
Result<std::string> ReadWholeFile(const std::filesystem::path& file);

/// Allows models to name files outside their own folder, for the whole program. Off at first: a
/// downloaded model could otherwise read any file of the user.
void AllowFilesOutsideModels(bool allowed);

/// Error (input): a file that a model names lies outside the model's folder, also by "..", by
/// percent-encoding or behind a symbolic link; or its name holds a NUL. Looks at no file outside.
/// `folder`: empty for the working folder.
Result<void> CheckBelongsToModel(const std::filesystem::path& file,
                                 const std::filesystem::path& folder);

}  // namespace pleinair::compositor
