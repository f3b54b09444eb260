#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "base/error.h"

namespace pleinair::files {

// What a command may replace (docs/guide/reference/outputs.md, "What is replaced"). A file that the
// user names is replaced, unless the command reads it. A file whose name the program chooses, in a
// folder of the user, replaces no file of the user.

/// For a file that the user names with `option`. `inputs`: files and folders that the command
/// reads; names of nothing are allowed. Errors (input): the name is empty; the file is an input,
/// also by a link; it exists inside a folder that the command reads.
Result<void> CheckNamedOutput(const std::string& option, const std::string& output,
                              std::span<const std::string> inputs);

/// For a file whose name the program chooses. `content`: the bytes to write, if known. Error
/// (input): there is a file with other bytes.
Result<void> CheckFreeName(const std::filesystem::path& file, std::string_view content = {});

}  // namespace pleinair::files
