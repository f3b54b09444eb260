#include "app/sinks/output_folder.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "base/atomic_file.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

/// Names that a replay writes; only these are removed of an earlier one.
bool IsReplayOutput(const fs::path& relative) {
  const std::string folder = relative.parent_path().string();
  const std::string name = relative.filename().string();
  if (folder.empty()) {
    return name == "composite.mp4" || name == "detections.jsonl" || name == "report.json" ||
           name == "report.html";
  }
  if (folder == "poses") return relative.extension() == ".tum";
  const std::string stem = relative.stem().string();
  return folder == "frames" && relative.extension() == ".png" && stem.size() >= 4 &&
         std::all_of(stem.begin(), stem.end(), [](unsigned char c) { return std::isdigit(c); });
}

void RemoveEarlierReplay(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / "report.json", error)) return;
  std::vector<fs::path> old_files;
  for (const char* part : {"", "poses", "frames"}) {
    for (fs::directory_iterator it(folder / part, error), end; !error && it != end;
         it.increment(error)) {
      if (IsReplayOutput(fs::path(part) / it->path().filename())) old_files.push_back(it->path());
    }
  }
  for (const fs::path& file : old_files) fs::remove(file, error);
  for (const char* part : {"poses", "frames"}) {
    fs::remove(folder / part, error);  // Only if nothing else is in it.
  }
}

}  // namespace

Result<OutputFolder> OutputFolder::Create(const fs::path& path) {
  OutputFolder folder;
  std::error_code error;
  folder.path_ = fs::absolute(path, error).lexically_normal();
  if (!folder.path_.has_filename()) folder.path_ = folder.path_.parent_path();
  std::vector<fs::path> missing;
  for (fs::path at = folder.path_; !fs::exists(at, error) && at.has_relative_path();
       at = at.parent_path()) {
    missing.push_back(at);
  }
  for (auto it = missing.rbegin(); it != missing.rend(); ++it) {
    if (!fs::create_directory(*it, error)) {
      return tl::make_unexpected(WriteError(*it, error.value()));
    }
    folder.created_.push_back(*it);
  }
  if (!fs::is_directory(folder.path_, error)) {
    return InputError(path.string(), "is not a folder", "name another folder with -o");
  }
  const fs::path staging = folder.path_ / (".pleinair.part" + std::to_string(getpid()));
  if (!fs::create_directory(staging, error)) {
    return tl::make_unexpected(WriteError(path, error ? error.value() : EEXIST));
  }
  folder.staging_ = staging;
  return folder;
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : path_(std::move(other.path_)),
      staging_(std::exchange(other.staging_, {})),
      created_(std::exchange(other.created_, {})) {}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
  for (auto it = created_.rbegin(); it != created_.rend(); ++it) fs::remove(*it, ignored);
}

Result<void> OutputFolder::MakeFolder(const std::string& name) const {
  std::error_code error;
  fs::create_directory(staging_ / name, error);
  if (error) return tl::make_unexpected(WriteError(path_ / name, error.value()));
  return {};
}

Error OutputFolder::InTermsOfTarget(Error error) const {
  const std::string staged = staging_.string();
  if (!staged.empty() && error.where.starts_with(staged)) {
    error.where = path_.string() + error.where.substr(staged.size());
  }
  return error;
}

Result<void> OutputFolder::Commit() {
  std::error_code error;
  std::vector<fs::path> files, folders;
  for (fs::recursive_directory_iterator it(staging_, error), end; !error && it != end;
       it.increment(error)) {
    (it->is_directory() ? folders : files).push_back(fs::relative(it->path(), staging_));
  }
  if (error) return tl::make_unexpected(WriteError(path_, error.value()));
  std::sort(files.begin(), files.end());
  RemoveEarlierReplay(path_);
  std::vector<fs::path> moved;
  const auto undo = [&](const fs::path& culprit) {
    const int error_number = error.value();
    std::error_code ignored;
    for (auto it = moved.rbegin(); it != moved.rend(); ++it) fs::remove(*it, ignored);
    return tl::make_unexpected(WriteError(culprit, error_number));
  };
  for (const fs::path& folder : folders) {
    if (fs::create_directory(path_ / folder, error)) moved.push_back(path_ / folder);
    if (error) return undo(path_ / folder);
  }
  for (const fs::path& file : files) {
    fs::rename(staging_ / file, path_ / file, error);
    if (error) return undo(path_ / file);
    moved.push_back(path_ / file);
  }
  fs::remove_all(staging_, error);
  staging_.clear();
  created_.clear();
  return {};
}

}  // namespace pleinair::app
