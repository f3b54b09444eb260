#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "session/marker_tracks.h"

namespace pleinair::app {

/// Selects at most four frames for a report. They are spread evenly over the frames of the
/// trajectory. If no frame has a pose, they are spread over all of the `frames`, of which
/// the first has the index `first`.
std::set<std::int64_t> ReportFrames(const std::vector<session::Observation>& path,
                                    std::int64_t first, std::int64_t frames);

}  // namespace pleinair::app
