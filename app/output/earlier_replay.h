#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// The files that an earlier replay wrote to a folder, from its report.json. Only these files may
/// be replaced or removed; all others belong to the user.
class EarlierReplay {
 public:
  /// Reads `folder`/report.json. Without a report of a replay, no file counts as written.
  static EarlierReplay In(const std::filesystem::path& folder);

  /// True if it wrote this file (relative to the folder).
  bool Wrote(const std::filesystem::path& relative) const;

  /// Error (input): a file has the name of a replay's output, but no replay wrote it.
  Result<void> CheckNothingForeign() const;

  /// Removes the files that it wrote, its report last, and the folders that become empty.
  void Remove() const;

 private:
  /// Existing files with the names of a replay's outputs, relative, sorted.
  std::vector<std::filesystem::path> FilesNamedLikeOutputs() const;

  std::filesystem::path folder_;
  std::set<std::string> outputs_;
  struct Frames {
    std::int64_t first = 0, count = 0;
  } frames_;  // Numbers of the images in frames/.
};

/// The error for a file that must not be replaced.
tl::unexpected<Error> NotFromAReplay(const std::filesystem::path& file);

/// Error (input): the folder is a recording, or holds a recording's frames. No error if it does not
/// exist.
Result<void> CheckIsNoRecording(const std::filesystem::path& folder);

}  // namespace pleinair::app
