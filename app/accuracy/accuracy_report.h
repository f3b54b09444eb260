#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/accuracy/record_parts.h"
#include "base/error.h"

namespace pleinair::app {

struct WrittenReport {
  std::int64_t frames = 0;
  std::vector<std::string> skipped;  ///< Recordings that could not be measured, with the reason.
};

/// Merges the parts of one run from any number of folders into report.json, report.html,
/// records.jsonl and times.json in `output`. All except times.json depend only on the
/// configuration: the bytes are the same for any sharding. A chunk in several folders counts once.
/// Errors: folders of different runs (input); chunks in no folder, which must still be measured
/// (system).
Result<WrittenReport> WriteAccuracyReport(const std::vector<RecordParts>& folders,
                                          const std::filesystem::path& output);

}  // namespace pleinair::app
