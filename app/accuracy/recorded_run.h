#pragma once

#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "app/accuracy/accuracy_config.h"
#include "base/error.h"

namespace pleinair::app {

/// A finished run as its folder has it.
struct RecordedRun {
  AccuracyConfig config;
  std::vector<accuracy::FrameRecord> records;
};

/// Reads run.json and records.jsonl of a folder (or of the folder of a file in it, such as its
/// report.json). Errors (input): what is missing or no such file, with its line.
Result<RecordedRun> ReadRecordedRun(const std::string& folder);

}  // namespace pleinair::app
