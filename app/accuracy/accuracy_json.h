#pragma once

#include <set>
#include <string>
#include <vector>

#include "accuracy/summary.h"
#include "app/accuracy/accuracy_config.h"
#include "app/accuracy/light_run.h"

namespace pleinair::app {

/// The content of a run's report. Times are separate, since they differ between runs.
struct AccuracyReport {
  AccuracyConfig config;
  std::string version;
  std::set<std::string> machines;  ///< That measured it; only on the page.
  accuracy::RunSummary summary;
  std::vector<LightPicture> pictures;
  std::vector<std::string> skipped;  ///< Recordings that could not be measured, with the reason.
};

/// A recording whose marker a peer cannot decode.
struct UnreadFilm {
  std::string film, peer;
};
std::vector<UnreadFilm> UnreadFilms(const AccuracyReport& report);

/// Returns report.json (docs/guide/accuracy-runs.md). Numbers have nine significant digits. Values
/// that are not finite are null.
std::string AccuracyJson(const AccuracyReport& report);

}  // namespace pleinair::app
