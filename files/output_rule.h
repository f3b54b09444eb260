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

/// Checks that a command may write the file that the user names with `option`. `inputs`: files and
/// folders that the command reads; names that do not exist are ignored. Errors (input): the name is
/// empty; the file is an input, also by a link; it exists inside a folder that the command reads.
Result<void> CheckNamedOutput(const std::string& option, const std::string& output,
                              std::span<const std::string> inputs);

/// Checks that a command may write a file whose name the program chooses. `content`: the bytes to
/// write; empty: not known. Error (input): there is a file, and it does not have these bytes.
Result<void> CheckFreeName(const std::filesystem::path& file, std::string_view content = {});

}  // namespace pleinair::files
