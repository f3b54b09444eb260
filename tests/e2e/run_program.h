#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pleinair::e2e {

/// What a run of a program left behind.
struct RunResult {
  int exit_code = -1;  ///< -1 where a signal ended it.
  std::string out;
  std::string err;
};

/// Runs a program with arguments, without a shell's interpretation. `prefix` is shell text put
/// before it ("ulimit -f 64;").
RunResult RunCommandLine(const std::vector<std::string>& arguments, const std::string& prefix = "");

/// The program under test: the environment's PLEINAIR_PROGRAM (one built with sanitizers, say),
/// else the one of the tests' own build.
std::string PleinairProgram();

/// That program, with arguments.
RunResult RunPleinair(std::vector<std::string> arguments, const std::string& prefix = "");

/// A folder that goes when the test ends.
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

/// Names of everything below a folder, relative, sorted; empty where it is not there.
std::vector<std::string> Listing(const std::filesystem::path& folder);

/// The first `frames` frames of the bundled recording as a recording of its own, with a scene that
/// a person could have written: the marker, the phantoms, and the virtual object if `with_object`.
void MakeShortRecording(const std::filesystem::path& folder, int frames, bool with_object);

/// Where the bundled recording lies.
std::filesystem::path BundledRecording();

}  // namespace pleinair::e2e
