#include "app/project/project_folder.h"

#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "app/project/scene_text.h"
#include "base/atomic_file.h"
#include "export/images/image_writer.h"
#include "files/text_file.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

// recording.json comes last: it makes the folder a project.
constexpr const char* kProjectFiles[] = {"scene.toml", "first.png", "recording.json"};

fs::path Normal(const fs::path& folder) {
  std::error_code error;
  const fs::path path = fs::absolute(folder, error).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

bool IsOurs(const fs::path& folder) {
  const auto bytes = files::ReadWholeFile(folder / "recording.json", files::kMaxDescriptionBytes);
  if (!bytes) return false;
  const nlohmann::json json = nlohmann::json::parse(*bytes, nullptr, false);
  return json.is_object() && json.value("program", nlohmann::json()) == kNewProgram;
}

/// The folders of a new project while it is written.
class Staging {
 public:
  explicit Staging(fs::path folder) : folder_(std::move(folder)) {}
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;
  ~Staging() {
    std::error_code ignored;
    if (!staging_.empty()) fs::remove_all(staging_, ignored);
    // Only those that are empty.
    for (auto it = created_.rbegin(); it != created_.rend(); ++it) fs::remove(*it, ignored);
  }

  Result<fs::path> Create() {
    std::error_code error;
    std::vector<fs::path> missing;
    for (fs::path at = folder_; !fs::exists(at, error) && at.has_relative_path();
         at = at.parent_path()) {
      missing.push_back(at);
    }
    missing.insert(missing.begin(), folder_ / (".pleinair.part" + std::to_string(getpid())));
    for (auto it = missing.rbegin(); it != missing.rend(); ++it) {
      const bool is_ours = fs::create_directory(*it, error), is_last = it + 1 == missing.rend();
      if (error || (is_last && !is_ours)) {
        return tl::make_unexpected(WriteError(*it, error ? error.value() : EEXIST));
      }
      if (is_ours && !is_last) created_.push_back(*it);
    }
    staging_ = missing.front();
    return staging_;
  }

  Result<void> Commit() {
    std::error_code error;
    for (const char* name : kProjectFiles) {
      fs::rename(staging_ / name, folder_ / name, error);
      if (error) return tl::make_unexpected(WriteError(folder_ / name, error.value()));
    }
    return {};
  }

 private:
  fs::path folder_, staging_;
  std::vector<fs::path> created_;  // Outermost first.
};

Result<void> WriteStaged(const ProjectFiles& files, Staging& staging) {
  PLEINAIR_ASSIGN_OR_RETURN(const fs::path to, staging.Create());
  PLEINAIR_RETURN_IF_ERROR(exports::WritePng(to / "first.png", files.first_picture.view()));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(to / "scene.toml", files.scene_toml));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(to / "recording.json", files.recording_json));
  return staging.Commit();
}

}  // namespace

Result<void> CheckProjectFolder(const fs::path& folder, bool replaces) {
  const fs::path path = Normal(folder);
  std::error_code error;
  const bool exists = fs::exists(path, error);
  if (exists && !fs::is_directory(path, error)) {
    return InputError(folder.string(), "is not a folder", "name another folder with -o");
  }
  const bool is_ours = exists && IsOurs(path);
  if (is_ours && !replaces) {
    return InputError(folder.string(), "is a project already",
                      "name another folder with -o, or add --force to replace its scene.toml, "
                      "recording.json and first.png");
  }
  for (const char* name : {"recording.json", "scene.toml", "scene.json", "first.png", "frames.pack",
                           "mav0", "cam0", "data.csv"}) {
    const bool is_replaced = is_ours && std::string_view(name) != "scene.json";
    if (is_replaced || !fs::exists(path / name, error)) continue;
    return InputError((path / name).string(),
                      "is there already, and 'pleinair new' did not write it",
                      "name another folder with -o");
  }
  fs::path existing = path;
  while (!fs::exists(existing, error) && existing.has_relative_path()) {
    existing = existing.parent_path();
  }
  if (!fs::is_directory(existing, error)) {
    return InputError(existing.string(),
                      "is a file, and " + folder.string() + " needs a folder there",
                      "name another folder with -o");
  }
  if (access(existing.c_str(), W_OK | X_OK) != 0) {
    return tl::make_unexpected(WriteError(folder, errno));
  }
  return {};
}

Result<void> WriteProject(const ProjectFiles& files, const fs::path& folder, bool replaces) {
  // Again: time has passed.
  PLEINAIR_RETURN_IF_ERROR(CheckProjectFolder(folder, replaces));
  Staging staging(Normal(folder));
  Result<void> written = WriteStaged(files, staging);
  if (!written) written.error().where = folder.string();
  return written;
}

}  // namespace pleinair::app
