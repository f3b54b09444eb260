#pragma once

#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "app/accuracy/accuracy_json.h"

namespace pleinair::app {

/// Images of our detector's worst frames with the true outlines (green) and the detected ones
/// (red). The order is false numbers, misplaced markers, flips, and the largest corner errors.
std::string WorstFrames(const AccuracyReport& report,
                        const std::vector<accuracy::FrameRecord>& records);

}  // namespace pleinair::app
