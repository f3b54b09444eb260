#pragma once

#include <cstddef>
#include <vector>

#include "session/marker_tracks.h"

namespace pleinair::session {

/// Numbers below `size`, at most `most`: the middles of as many equal parts.
std::vector<std::size_t> EvenlySpread(std::size_t size, std::size_t most);

/// Indices into a camera's path of the frames that the light is read from: at most eight, spread
/// evenly over as much of its middle as one place of the sun serves.
std::vector<std::size_t> LightFrames(const std::vector<Observation>& path);

}  // namespace pleinair::session
