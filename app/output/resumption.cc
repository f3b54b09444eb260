#include "app/output/resumption.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "base/atomic_file.h"
#include "files/text_file.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFramesFolder = "frames";
constexpr std::size_t kMaxIdentityBytes = 1 << 20;
constexpr const char* kRemedy =
    "repeat the first command, remove this folder to begin anew, or name another one with -o";

/// FNV-1a, 64 bits (Fowler, Noll, Vo 1991), of a whole file.
Result<std::string> HashOf(const fs::path& file) {
  constexpr std::uint64_t kOffset = 0xcbf29ce484222325, kPrime = 0x100000001b3;
  std::ifstream in(file, std::ios::binary);
  if (!in) return SystemError(file.string(), "cannot be read", "repeat the command");
  std::uint64_t hash = kOffset;
  for (std::istreambuf_iterator<char> it(in), end; it != end; ++it) {
    hash = (hash ^ static_cast<unsigned char>(*it)) * kPrime;
  }
  return fmt::format("{:016x}", hash);
}

/// Size and time of change of a file; a missing one has neither.
std::string StateOf(const fs::path& file) {
  std::error_code error;
  const auto changed = fs::last_write_time(file, error).time_since_epoch().count();
  if (error) return "missing";
  const auto bytes = fs::is_regular_file(file, error) ? fs::file_size(file, error) : 0;
  return fmt::format("{} {}", bytes, changed);
}

/// What tells one program from another: its version and its file.
std::string ProgramText() { return PLEINAIR_VERSION " " + StateOf("/proc/self/exe"); }

/// A file's entry: its state, then its name, which may have spaces.
std::string EntryOf(const fs::path& file) {
  std::string name = file.string();
  std::replace(name.begin(), name.end(), '\n', ' ');
  return StateOf(file) + " " + name;
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The first difference between the stored identity and that of this replay, for a message.
std::string DifferenceBetween(const std::vector<std::string>& stored,
                              const std::vector<std::string>& now,
                              const std::vector<fs::path>& files) {
  if (stored.size() < 2) return "has lost the identity of its replay";
  if (stored[0] != now[0]) {
    return "was begun by pleinair " + stored[0].substr(0, stored[0].find(' ')) +
           ", or by another build of this version";
  }
  if (stored[1] != now[1]) return "was begun by another command: " + stored[1];
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (i + 2 >= stored.size() || stored[i + 2] != now[i + 2]) {
      return "is of other inputs: " + files[i].string() + " has changed since";
    }
  }
  return "is of other inputs";
}

fs::path IdentityFile(const fs::path& staging) { return staging / kResumeFolder / "identity"; }

/// True if a file, or anything in a folder but in `results`, has changed after `time`.
bool HasNewer(const fs::path& input, fs::file_time_type time, const fs::path& results) {
  std::error_code error;
  if (!fs::is_directory(input, error)) {
    const fs::file_time_type changed = fs::last_write_time(input, error);
    return !error && changed > time;
  }
  for (fs::recursive_directory_iterator it(input, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code ignored;
    if (fs::equivalent(it->path(), results, ignored)) {
      it.disable_recursion_pending();
    } else if (it->is_regular_file(ignored) && it->last_write_time(ignored) > time) {
      return true;
    }
  }
  return false;
}

}  // namespace

Result<void> ClaimUnfinished(const fs::path& staging, const std::string& command,
                             const std::vector<fs::path>& files) {
  std::string identity = ProgramText() + "\n" + command + "\n";
  for (const fs::path& file : files) identity += EntryOf(file) + "\n";
  const fs::path file = IdentityFile(staging);
  if (!IsClaimed(staging)) {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error) return tl::make_unexpected(WriteError(file, error.value()));
    return WriteFileAtomically(file, identity);
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::string stored,
                            files::ReadWholeFile(file, kMaxIdentityBytes));
  if (stored == identity) return {};
  return InputError(staging.string(), DifferenceBetween(LinesOf(stored), LinesOf(identity), files),
                    kRemedy);
}

bool IsClaimed(const fs::path& staging) {
  std::error_code error;
  return fs::exists(IdentityFile(staging), error);
}

Result<void> DropFramesOfOtherDetections(const fs::path& staging) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string hash, HashOf(staging / "detections.jsonl"));
  const fs::path file = staging / kResumeFolder / "detections";
  std::error_code error;
  if (fs::exists(file, error)) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::string stored,
                              files::ReadWholeFile(file, kMaxIdentityBytes));
    if (stored == hash) return {};
    fs::remove_all(staging / "frames", error);
    if (error) return tl::make_unexpected(WriteError(staging / "frames", error.value()));
  }
  return WriteFileAtomically(file, hash);
}

Result<void> SetFramesAside(const fs::path& staging) {
  std::error_code error;
  fs::rename(staging / kFramesFolder, staging / kResumeFolder / kFramesFolder, error);
  if (error && error != std::errc::no_such_file_or_directory) {
    return tl::make_unexpected(WriteError(staging / kFramesFolder, error.value()));
  }
  return {};
}

void BringFramesBack(const fs::path& staging) {
  std::error_code error;  // Without frames there, they are composed again.
  fs::rename(staging / kResumeFolder / kFramesFolder, staging / kFramesFolder, error);
}

bool IsFinishedReplay(const fs::path& folder, const std::string& command,
                      const std::vector<fs::path>& inputs) {
  std::error_code error;
  const fs::file_time_type finished = fs::last_write_time(folder / "report.json", error);
  if (error || std::any_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
        return HasNewer(input, finished, folder);
      })) {
    return false;
  }
  if (fs::exists(folder / kUnfinishedFolder / kResumeFolder, error)) return false;
  std::ifstream in(folder / "report.json", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const nlohmann::json report = nlohmann::json::parse(text, nullptr, false);
  const auto says = [&](const char* key, const std::string& value) {
    return report.value(key, nlohmann::json()) == value;
  };
  return report.is_object() && says("program", "pleinair") && says("version", PLEINAIR_VERSION) &&
         says("command", command);
}

}  // namespace pleinair::app
