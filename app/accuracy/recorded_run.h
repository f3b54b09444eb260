#pragma once

#include <string>
#include <vector>

#include "accuracy/summary.h"
#include "app/accuracy/accuracy_config.h"
#include "base/error.h"

namespace pleinair::app {

/// A finished run as its folder has it.
struct RecordedRun {
  AccuracyConfig config;
  accuracy::RunRecords records;
};

/// Reads run.json, records.jsonl and, where it is there, pictures.jsonl of a folder (or of the
/// folder of a file in it, such as its report.json). Errors (input): what is missing or no such
/// file, with its line.
Result<RecordedRun> ReadRecordedRun(const std::string& folder);

}  // namespace pleinair::app
