#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// The folder that a replay writes to, all of it or nothing. Sinks write into staging(), a hidden
/// folder inside the target; Commit() moves everything to its place. Without Commit() the
/// destructor removes the staging folder and every folder that Create() made. Of a process that was
/// killed the next Create() in the same folder removes what it left.
class OutputFolder {
 public:
  /// Makes `path` and its parents where missing. Errors (input): no permission, not a folder, a
  /// recording or its frames, or a file there that has the name of a replay's output but is none
  /// that an earlier replay's report.json lists; (system): disk full.
  static Result<OutputFolder> Create(const std::filesystem::path& path);

  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&&) = delete;
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& staging() const { return staging_; }

  /// Makes a folder in the staging area.
  Result<void> MakeFolder(const std::string& name) const;

  /// An error about a staged file told of the file that it was to become.
  Error InTermsOfTarget(Error error) const;

  /// Replaces what an earlier replay's report.json lists and moves the staged files in; other files
  /// stay, and one in the way is an error (input). On an error the files already moved are removed
  /// again.
  Result<void> Commit();

 private:
  OutputFolder() = default;

  std::filesystem::path path_;
  std::filesystem::path staging_;
  std::vector<std::filesystem::path> created_;  // Outermost first.
};

}  // namespace pleinair::app
