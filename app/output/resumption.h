#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// The staging folder of a resumable replay, inside its output folder.
inline constexpr const char* kUnfinishedFolder = "unfinished";
/// Its folder with what only a resumption needs.
inline constexpr const char* kResumeFolder = ".resume";

/// Stores the identity of a replay in its staging folder: the command, the program, and size and
/// time of change of each of `files`. Files that do not exist belong to it. Error (input): the
/// folder has another identity; the message names the first difference.
Result<void> ClaimUnfinished(const std::filesystem::path& staging, const std::string& command,
                             const std::vector<std::filesystem::path>& files);

/// True if ClaimUnfinished() has stored an identity.
bool IsClaimed(const std::filesystem::path& staging);

/// Removes the frames of a staging folder if they were composed from other detections than those of
/// its detections.jsonl, and stores the hash of these. Errors: the file cannot be read, WriteError.
Result<void> DropFramesOfOtherDetections(const std::filesystem::path& staging);

/// Moves the frames from `staging` into its folder kResumeFolder, which OutputFolder::Commit() does
/// not publish. Error: WriteError.
Result<void> SetFramesAside(const std::filesystem::path& staging);
/// Moves such frames back into `staging`. No effect without any.
void BringFramesBack(const std::filesystem::path& staging);

/// True if a folder has the finished results of this command and version, nothing unfinished, and
/// its report.json is newer than all inputs. `inputs`: files, and folders with all that they hold,
/// except the results themselves.
bool IsFinishedReplay(const std::filesystem::path& folder, const std::string& command,
                      const std::vector<std::filesystem::path>& inputs);

}  // namespace pleinair::app
