#pragma once

#include <string>
#include <vector>

#include "accuracy/summary.h"
#include "app/accuracy/accuracy_config.h"

namespace pleinair::app {

/// All that a run's report says; times are kept apart, since no two runs have the same.
struct AccuracyReport {
  AccuracyConfig config;
  std::string version;
  accuracy::RunSummary summary;
  std::vector<std::string> skipped;  ///< Recordings that could not be measured, and why.
};

/// report.json (docs/accuracy-report.md). Numbers have nine significant digits; what is not a
/// number is null.
std::string AccuracyJson(const AccuracyReport& report);

}  // namespace pleinair::app
