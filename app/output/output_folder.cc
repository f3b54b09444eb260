#include "app/output/output_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/output/earlier_replay.h"
#include "app/output/resumption.h"
#include "base/atomic_file.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStagingPrefix = ".pleinair.part";  // Followed by the process id.

/// Removes the files that a killed process was writing, which have hidden names.
void RemovePartialFiles(const fs::path& folder) {
  std::vector<fs::path> partial;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (it->is_regular_file(error) && name.starts_with('.')) partial.push_back(it->path());
  }
  for (const fs::path& file : partial) fs::remove(file, error);
}

/// Removes staging folders of killed processes, also one with this process's id.
void RemoveAbandonedStaging(const fs::path& folder) {
  std::vector<fs::path> abandoned;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with(kStagingPrefix)) continue;
    const char* last = name.data() + name.size();
    pid_t process = 0;
    const auto parsed = std::from_chars(name.data() + kStagingPrefix.size(), last, process);
    if (parsed.ec != std::errc() || parsed.ptr != last || process <= 0) continue;
    const bool is_dead = kill(process, 0) != 0 && errno == ESRCH;
    std::error_code ignored;
    if ((is_dead || process == getpid()) && fs::is_directory(it->symlink_status(ignored))) {
      abandoned.push_back(it->path());
    }
  }
  for (const fs::path& staging : abandoned) fs::remove_all(staging, error);
}

}  // namespace

Result<OutputFolder> OutputFolder::Create(const fs::path& path, bool is_resumable) {
  OutputFolder folder;
  folder.is_resumable_ = is_resumable;
  std::error_code error;
  folder.path_ = fs::absolute(path, error).lexically_normal();
  if (!folder.path_.has_filename()) folder.path_ = folder.path_.parent_path();
  PLEINAIR_RETURN_IF_ERROR(CheckIsNoRecording(folder.path_));
  PLEINAIR_RETURN_IF_ERROR(EarlierReplay::In(folder.path_).CheckNothingForeign());
  std::vector<fs::path> missing;
  for (fs::path at = folder.path_; !fs::exists(at, error) && at.has_relative_path();
       at = at.parent_path()) {
    missing.push_back(at);
  }
  for (auto it = missing.rbegin(); it != missing.rend(); ++it) {
    // A folder that another process makes meanwhile is there, and not ours to remove.
    const bool is_ours = fs::create_directory(*it, error);
    if (error) return tl::make_unexpected(WriteError(*it, error.value()));
    if (is_ours) folder.created_.push_back(*it);
  }
  if (!fs::is_directory(folder.path_, error)) {
    return InputError(path.string(), "is not a folder", "name another folder with -o");
  }
  folder.lock_ = open(folder.path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder.lock_ >= 0 && flock(folder.lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    return InputError(path.string(), "another replay is writing into this folder",
                      "wait until it has ended, or name another folder with -o");
  }
  RemoveAbandonedStaging(folder.path_);
  const fs::path staging =
      folder.path_ / (is_resumable ? std::string(kUnfinishedFolder)
                                   : std::string(kStagingPrefix) + std::to_string(getpid()));
  const bool is_there = is_resumable && fs::exists(staging, error);
  if (is_there && !fs::exists(staging / kResumeFolder, error) && !fs::is_empty(staging, error)) {
    return InputError(staging.string(), "is there already, and no replay wrote it",
                      "name another folder with -o, or move it away");
  }
  if (!is_there && !fs::create_directory(staging, error)) {
    return tl::make_unexpected(WriteError(path, error ? error.value() : EEXIST));
  }
  if (is_resumable) {
    fs::create_directory(staging / kResumeFolder, error);
    if (error) return tl::make_unexpected(WriteError(staging, error.value()));
    RemovePartialFiles(staging);
    BringFramesBack(staging);
  }
  folder.staging_ = staging;
  return folder;
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : path_(std::move(other.path_)),
      staging_(std::exchange(other.staging_, {})),
      is_resumable_(other.is_resumable_),
      created_(std::exchange(other.created_, {})),
      lock_(std::exchange(other.lock_, -1)) {}

OutputFolder::~OutputFolder() {
  CleanUp()();
  if (lock_ >= 0) close(lock_);
}

std::function<void()> OutputFolder::CleanUp() const {
  return [staging = staging_, created = created_, is_resumable = is_resumable_] {
    std::error_code ignored;
    if (is_resumable && IsClaimed(staging)) return;
    if (!staging.empty()) fs::remove_all(staging, ignored);
    for (auto it = created.rbegin(); it != created.rend(); ++it) fs::remove(*it, ignored);
  };
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
    if (it->path().filename() == kResumeFolder) {
      it.disable_recursion_pending();
      continue;
    }
    (it->is_directory() ? folders : files).push_back(fs::relative(it->path(), staging_));
  }
  if (error) return tl::make_unexpected(WriteError(path_, error.value()));
  std::sort(files.begin(), files.end());
  // Checked again: the user may have added a file during the replay.
  const EarlierReplay earlier = EarlierReplay::In(path_);
  for (const fs::path& file : files) {
    if (fs::exists(path_ / file, error) && !earlier.Wrote(file)) {
      return NotFromAReplay(path_ / file);
    }
  }
  earlier.Remove();
  std::vector<fs::path> moved;
  const auto undo = [&](const fs::path& culprit) {
    const int error_number = error.value();
    std::error_code ignored;
    for (auto it = moved.rbegin(); it != moved.rend(); ++it) {
      if (is_resumable_ && !fs::is_directory(*it, ignored)) {
        fs::rename(*it, staging_ / fs::relative(*it, path_, ignored), ignored);
      } else {
        fs::remove(*it, ignored);
      }
    }
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
  const fs::path unfinished = path_ / kUnfinishedFolder;
  if (fs::exists(unfinished / kResumeFolder, error)) fs::remove_all(unfinished, error);
  staging_.clear();
  created_.clear();
  return {};
}

}  // namespace pleinair::app
