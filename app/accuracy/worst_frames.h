#pragma once

#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "app/accuracy/accuracy_json.h"

namespace pleinair::app {

/// The frames in which our detector did worst, as pictures with the true outlines (green) and the
/// found ones (red): false numbers first, then misplaced markers, flips, and the largest corner
/// errors.
std::string WorstFrames(const AccuracyReport& report,
                        const std::vector<accuracy::FrameRecord>& records);

}  // namespace pleinair::app
