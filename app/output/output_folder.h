#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// A replay's output folder, written as a whole or not at all. Writers write into staging(), a
/// hidden folder inside the target. Commit() moves everything to its place. Without Commit() the
/// destructor removes the staging folder and every folder that Create() made. After a killed
/// process, the next Create() in the same folder removes its staging folder. A lock on the folder
/// keeps a second replay out while the first one lasts, so that outputs never mix.
///
/// A resumable folder stages in `unfinished` inside the target. Once a replay has claimed it
/// (ClaimUnfinished()), it stays without Commit(), and the next resumable Create() finds it again.
class OutputFolder {
 public:
  /// Creates `path` and its missing parents. Errors (input): no permission, not a folder, a
  /// recording or its frames; another replay is writing into it. Also an existing file with the
  /// name of a replay's output that no earlier report.json lists, and an `unfinished` that no
  /// replay wrote. Errors (system): disk full.
  static Result<OutputFolder> Create(const std::filesystem::path& path, bool is_resumable = false);

  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&&) = delete;
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& staging() const { return staging_; }

  /// Creates a folder in the staging area.
  Result<void> MakeFolder(const std::string& name) const;

  /// Replaces the path of a staged file in an error by its target path.
  Error InTermsOfTarget(Error error) const;

  /// What the destructor does without Commit(), for a program that must end at once. The result
  /// may outlive this object.
  std::function<void()> CleanUp() const;

  /// Replaces the files in an earlier replay's report.json by the staged files. Other files stay;
  /// one with an output's name is an error (input). After an error the moved files are removed
  /// again. Removes what an earlier resumable folder left unfinished.
  Result<void> Commit();

 private:
  OutputFolder() = default;

  std::filesystem::path path_;
  std::filesystem::path staging_;
  bool is_resumable_ = false;
  std::vector<std::filesystem::path> created_;  // Outermost first.
  int lock_ = -1;                               // Open folder; -1 where locks are not supported.
};

}  // namespace pleinair::app
