#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "session/marker_tracks.h"

namespace pleinair::app {

/// Selects at most four frames for a report. They are spread evenly over the frames of the
/// trajectory. If no frame has a pose, they are spread over all `frames` of the recording.
std::set<std::int64_t> ReportFrames(const std::vector<session::Observation>& path,
                                    std::int64_t frames);

}  // namespace pleinair::app
