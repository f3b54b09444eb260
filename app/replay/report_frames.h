#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "session/marker_tracks.h"

namespace pleinair::app {

/// The frames that a report shows, at most four: spread evenly over those of the path or, where
/// none has a pose, over all `frames` of the recording.
std::set<std::int64_t> ReportFrames(const std::vector<session::Observation>& path,
                                    std::int64_t frames);

}  // namespace pleinair::app
