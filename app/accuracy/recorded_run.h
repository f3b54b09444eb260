#pragma once

#include <string>
#include <vector>

#include "accuracy/summary.h"
#include "app/accuracy/accuracy_config.h"
#include "base/error.h"

namespace pleinair::app {

/// A finished run, as read from its folder.
struct RecordedRun {
  AccuracyConfig config;
  accuracy::RunRecords records;
};

/// Reads run.json, records.jsonl and, if present, pictures.jsonl of a folder. `folder` may also
/// name a file in it, such as report.json. Errors (input): missing or invalid files, with the line.
Result<RecordedRun> ReadRecordedRun(const std::string& folder);

}  // namespace pleinair::app
