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

/// Checks that a model may read a file that it names. `folder`: that of the model; empty: the
/// working folder. Errors (input): the file lies outside the folder, also by "..", by
/// percent-encoding or behind a symbolic link. The name holds a NUL. Does not open the file.
Result<void> CheckBelongsToModel(const std::filesystem::path& file,
                                 const std::filesystem::path& folder);

}  // namespace pleinair::compositor
