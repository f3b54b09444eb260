#pragma once

#include <string>
#include <vector>

#include "session/marker_tracks.h"

namespace pleinair::app {

/// Table of the sources of poses, one line a frame with a pose. Columns: `frame`, `timestamp_s`,
/// `source` (marker, anchors, motion or trajectory), `marker_seen` (1 or 0), `centre_deviation_m`.
/// The last is the standard deviation of the marker's centre by the alignment, empty for other
/// sources.
std::string PoseSourcesCsv(const std::vector<session::Observation>& path);

}  // namespace pleinair::app
