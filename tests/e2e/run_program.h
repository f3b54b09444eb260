#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pleinair::e2e {

/// Result of a program run.
struct RunResult {
  int exit_code = -1;  ///< -1 if a signal ended it.
  std::string out;
  std::string err;
};

/// Runs a program with arguments, without shell interpretation of them. `prefix` is shell text
/// before the command ("ulimit -f 64;").
RunResult RunCommandLine(const std::vector<std::string>& arguments, const std::string& prefix = "");

/// The program under test: the environment's PLEINAIR_PROGRAM (for example a sanitizer build), else
/// the one of this build.
std::string PleinairProgram();

/// Runs that program with arguments.
RunResult RunPleinair(std::vector<std::string> arguments, const std::string& prefix = "");

/// A temporary folder, removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

std::string ReadFile(const std::filesystem::path& file);
void WriteFile(const std::filesystem::path& file, const std::string& content);

/// Relative names of everything below a folder, sorted; empty if there is no such folder.
std::vector<std::string> Listing(const std::filesystem::path& folder);

/// Writes the first `frames` frames of the bundled recording as a recording, with a user-style
/// scene: the marker, the phantoms, and the virtual object if `with_object`.
void MakeShortRecording(const std::filesystem::path& folder, int frames, bool with_object);

/// Folder of the bundled recording.
std::filesystem::path BundledRecording();

}  // namespace pleinair::e2e
