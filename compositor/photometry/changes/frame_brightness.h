#pragma once

// Internal: between .cc files.

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "compositor/photometry/changes/probe_fit.h"

namespace pleinair::compositor {

/// Brightness of each frame over the first one that shows any of the probes for which `counts`
/// holds, logarithmic: the medians of what the probes became from frame to frame, so that a camera
/// may move on to other surfaces. None for frames with fewer than `min_probes` of them.
std::vector<std::optional<double>> FrameBrightness(
    const std::vector<ProbeFit>& probes, std::size_t frame_count, std::size_t min_probes,
    const std::function<bool(const ProbeFit&)>& counts);

}  // namespace pleinair::compositor
