#pragma once

#include <string>
#include <vector>

#include "accuracy/frame_record.h"

namespace pleinair::app {

/// Of a sweep that is a film (or of recordings): the first detector's path of the camera beside
/// the true one, and its errors over time; nothing for other sweeps.
std::string FilmPlots(const std::string& sweep, const std::vector<std::string>& detectors,
                      const std::vector<accuracy::FrameRecord>& records);

}  // namespace pleinair::app
