#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "session/marker_tracks.h"

namespace pleinair::app {

/// Indices into a camera's path of the frames that the light is read from: at most eight, spread
/// evenly over as much of its middle as one place of the sun serves.
std::vector<std::size_t> LightFrames(const std::vector<session::Observation>& path);

/// The frames that a report shows, at most four: spread evenly over those of the path or, where
/// none has a pose, over all `frames` of the recording.
std::set<std::int64_t> ReportFrames(const std::vector<session::Observation>& path,
                                    std::int64_t frames);

}  // namespace pleinair::app
