#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "app/accuracy/accuracy_config.h"
#include "app/accuracy/light_run.h"
#include "base/error.h"

namespace pleinair::app {

/// Results of one chunk of a run.
struct RecordPart {
  std::int64_t chunk = 0;
  std::vector<accuracy::FrameRecord> records;
  std::vector<LightPicture> pictures;
  std::string skipped;  ///< Why it could not be measured; empty if it could.
  ErrorKind skipped_kind = ErrorKind::kSystem;  ///< Kind of the error in `skipped`; not stored.
  std::string machine;                          ///< That measured it.
};

/// Storage of a run's results: one file per chunk, written atomically. An interrupted run continues
/// where it stopped, and several machines may write to one folder. File names contain only the
/// chunk, so that a chunk measured twice counts once.
class RecordParts {
 public:
  /// Creates the folder with its run.json, or opens that of an earlier run. Errors (input): the
  /// folder holds a run of another configuration, or files that no run wrote; it is a recording; no
  /// permission.
  static Result<RecordParts> Open(const std::filesystem::path& folder, const AccuracyConfig& config,
                                  std::int64_t chunks);
  /// Opens an existing folder. Errors (input): there is none.
  static Result<RecordParts> Read(const std::filesystem::path& folder);

  /// Creates a folder of this run with its run.json. Errors: as Open().
  Result<void> ClaimFolder(const std::filesystem::path& folder) const;

  const std::filesystem::path& folder() const { return folder_; }
  const AccuracyConfig& config() const { return config_; }
  std::int64_t chunks() const { return chunks_; }

  /// True if a chunk exists and was not skipped.
  bool Has(std::int64_t chunk) const;
  Result<void> Write(const RecordPart& part) const;
  /// Nothing if the chunk is missing or damaged.
  Result<std::optional<RecordPart>> Load(std::int64_t chunk) const;

 private:
  RecordParts() = default;
  std::filesystem::path FileOf(std::int64_t chunk) const;

  std::filesystem::path folder_;
  AccuracyConfig config_;
  std::string config_json_;
  std::int64_t chunks_ = 0;
};

}  // namespace pleinair::app
