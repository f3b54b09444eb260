#pragma once

#include <string>
#include <vector>

#include "accuracy/frame_record.h"

namespace pleinair::app {

/// Plots for sweeps that are videos, and for recordings: the first detector's trajectory with the
/// ground truth, and its errors over time. Empty for other sweeps.
std::string FilmPlots(const std::string& sweep, const std::vector<std::string>& detectors,
                      const std::vector<accuracy::FrameRecord>& records);

}  // namespace pleinair::app
