#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// What an earlier replay says, in the report.json that it left in a folder, that it wrote there.
/// Only such files may be replaced or removed; whatever else lies there is somebody's own.
class EarlierReplay {
 public:
  /// Reads `folder`/report.json. Without one, or with one that no replay wrote, nothing counts as
  /// written.
  static EarlierReplay In(const std::filesystem::path& folder);

  /// Whether it wrote this file (relative to the folder).
  bool Wrote(const std::filesystem::path& relative) const;

  /// Error (input): a file that has the name of a replay's output, but was not written by one.
  Result<void> CheckNothingForeign() const;

  /// Removes the files that it wrote, its report last, and their folders where they are left
  /// empty.
  void Remove() const;

 private:
  /// Files there with names that a replay writes, relative, sorted.
  std::vector<std::filesystem::path> FilesNamedLikeOutputs() const;

  std::filesystem::path folder_;
  std::set<std::string> outputs_;
  std::int64_t frames_ = 0;  // Pictures 0000.png and on; 0 where it wrote none.
};

/// The error for a file that must not be replaced.
tl::unexpected<Error> NotFromAReplay(const std::filesystem::path& file);

/// Error (input): the folder is a recording, or holds a recording's frames. No error where it is
/// not there.
Result<void> CheckIsNoRecording(const std::filesystem::path& folder);

}  // namespace pleinair::app
