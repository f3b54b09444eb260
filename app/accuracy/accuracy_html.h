#pragma once

#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "app/accuracy/accuracy_json.h"

namespace pleinair::app {

/// Returns report.html: one page without external resources. It shows detection and corner error by
/// level with 95 % intervals, and tables of every sweep. It shows jitter, videos with their
/// trajectories, consistency of the covariances, and calibration of the ambiguity ratio. It also
/// shows ratios to the peers, error maps, and images of the worst frames. It follows the reader's
/// light or dark mode.
std::string AccuracyHtml(const AccuracyReport& report,
                         const std::vector<accuracy::FrameRecord>& records);

}  // namespace pleinair::app
