#pragma once

#include <cstddef>
#include <vector>

#include "session/marker_tracks.h"

namespace pleinair::session {

/// Selects at most `most` indices below `size`: the middles of as many equal parts.
std::vector<std::size_t> EvenlySpread(std::size_t size, std::size_t most);

/// Indices into a camera trajectory of the frames for light estimation. At most eight, evenly
/// spread over 30 s before and after its middle, in which the sun hardly moves.
std::vector<std::size_t> LightFrames(const std::vector<Observation>& path);

}  // namespace pleinair::session
