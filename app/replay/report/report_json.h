#pragma once

#include <filesystem>
#include <string>

#include "app/replay/report/report.h"
#include "base/error.h"

namespace pleinair::app {

/// Returns report.json (schema: docs/guide/reference/recordings.md). Two replays with the same
/// command give the same bytes, except in "timings".
std::string ReportJson(const ReplayReport& report);

/// One line for `replay --json`: a summary and the paths of the outputs.
std::string SummaryJson(const ReplayReport& report, const std::filesystem::path& folder);

}  // namespace pleinair::app
