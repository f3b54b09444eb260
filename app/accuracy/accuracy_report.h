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
  std::vector<std::string> skipped;  ///< Recordings that could not be measured, and why.
};

/// Puts the parts of one run, from any number of folders, together: report.json, report.html,
/// records.jsonl and times.json in `output`. All but times.json are functions of the configuration
/// alone: the same bytes however the run was divided. A chunk that several folders have counts
/// once. Errors: folders of different runs (input); chunks that none has (system: they are still
/// to be measured).
Result<WrittenReport> WriteAccuracyReport(const std::vector<RecordParts>& folders,
                                          const std::filesystem::path& output);

}  // namespace pleinair::app
