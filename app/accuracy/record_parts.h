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

/// What one chunk of a run gave.
struct RecordPart {
  std::int64_t chunk = 0;
  std::vector<accuracy::FrameRecord> records;
  std::vector<LightPicture> pictures;
  std::string skipped;  ///< Why nothing could be measured; empty where it could.
  std::string machine;  ///< That did it.
};

/// Where a run keeps what it has done: a file for each chunk that appears whole or not at all, so
/// that a run that was killed goes on where it stopped, and any number of machines may work into
/// one folder. The names of the files say the chunk and nothing of who did it: doing a chunk twice
/// counts once.
class RecordParts {
 public:
  /// Makes the folder, with its run.json, or takes up that of an earlier run. Errors (input): the
  /// folder holds a run of another configuration; no permission.
  static Result<RecordParts> Open(const std::filesystem::path& folder, const AccuracyConfig& config,
                                  std::int64_t chunks);
  /// An existing one. Errors (input): there is none.
  static Result<RecordParts> Read(const std::filesystem::path& folder);

  /// Says in another folder what run this is.
  Result<void> WriteRunFile(const std::filesystem::path& folder) const;

  const std::filesystem::path& folder() const { return folder_; }
  const AccuracyConfig& config() const { return config_; }
  std::int64_t chunks() const { return chunks_; }

  /// Whether a chunk is there and was not skipped.
  bool Has(std::int64_t chunk) const;
  Result<void> Write(const RecordPart& part) const;
  /// Nothing where the chunk is not there, or is damaged.
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
