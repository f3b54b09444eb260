#pragma once

#include <filesystem>
#include <utility>

#include "base/error.h"

namespace pleinair::app {

/// A folder for what a command needs while it runs. The destructor removes it.
class ScratchFolder {
 public:
  /// In TMPDIR. Error (system): it cannot be made.
  static Result<ScratchFolder> Create();
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  ~ScratchFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace pleinair::app
