#pragma once

#include <set>
#include <string>
#include <vector>

#include "accuracy/summary.h"
#include "app/accuracy/accuracy_config.h"
#include "app/accuracy/light_run.h"

namespace pleinair::app {

/// All that a run's report says; times are kept apart, since no two runs have the same.
struct AccuracyReport {
  AccuracyConfig config;
  std::string version;
  std::set<std::string> machines;  ///< That did it; on the page alone.
  accuracy::RunSummary summary;
  std::vector<LightPicture> pictures;
  std::vector<std::string> skipped;  ///< Recordings that could not be measured, and why.
};

/// A recording whose marker a peer cannot read.
struct UnreadFilm {
  std::string film, peer;
};
std::vector<UnreadFilm> UnreadFilms(const AccuracyReport& report);

/// report.json (docs/guide/accuracy-runs.md). Numbers have nine significant digits; what is not a
/// number is null.
std::string AccuracyJson(const AccuracyReport& report);

}  // namespace pleinair::app
