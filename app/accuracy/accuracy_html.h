#pragma once

#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "app/accuracy/accuracy_json.h"

namespace pleinair::app {

/// report.html: one page without any external resource. Detection and corner error by level with
/// 95 % intervals, tables of every sweep, jitter, films with their paths, the covariances'
/// consistency, the ambiguity ratio's calibration, ratios to the peers, error maps, and the worst
/// frames as pictures. Follows the reader's light or dark mode.
std::string AccuracyHtml(const AccuracyReport& report,
                         const std::vector<accuracy::FrameRecord>& records);

}  // namespace pleinair::app
