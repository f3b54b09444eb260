#pragma once

#include <filesystem>
#include <string>

#include "app/replay/report/report.h"
#include "base/error.h"

namespace pleinair::app {

/// report.json (docs/guide/reference/recordings.md has the schema). Two replays by the same command
/// give the same bytes except inside "timings".
std::string ReportJson(const ReplayReport& report);

/// One line for `replay --json`: what was done and where it lies.
std::string SummaryJson(const ReplayReport& report, const std::filesystem::path& folder);

}  // namespace pleinair::app
