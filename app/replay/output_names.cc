#include "app/replay/output_names.h"

#include <filesystem>
#include <map>
#include <system_error>

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

std::string OutputName(const std::string& recording) {
  std::error_code error;
  fs::path path = fs::absolute(recording, error).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  const fs::path name = path.filename();
  // The path of a description file stands for its recording's folder.
  if (name == "recording.json" || name == "scene.json") return path.parent_path().filename();
  return fs::is_directory(path, error) ? name.string() : path.stem().string();
}

}  // namespace

Result<std::vector<std::string>> OutputNames(const std::vector<std::string>& recordings) {
  std::vector<std::string> names;
  std::map<std::string, std::string> known;
  for (const std::string& recording : recordings) {
    std::string name = OutputName(recording);
    if (name.empty() || name == "." || name == "..") {
      return InputError(recording, "gives no name to its outputs", "name its folder");
    }
    const auto [other, is_new] = known.emplace(name, recording);
    if (!is_new) {
      return InputError(recording,
                        "would have the same output folder, " + name + ", as " + other->second,
                        "rename one of them, or give them to two commands");
    }
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace pleinair::app
