#pragma once

// Internal: between .cc files.

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "compositor/photometry/changes/probe_fit.h"

namespace pleinair::compositor {

/// Estimates how bright each frame is by the probes for which `counts` holds. The result is the
/// logarithm over the first frame that shows any of them. It is the median of the probes' changes
/// from frame to frame, so that the camera may move on to other surfaces. Frames with fewer than
/// `min_probes` of them have no value.
std::vector<std::optional<double>> FrameBrightness(
    const std::vector<ProbeFit>& probes, std::size_t frame_count, std::size_t min_probes,
    const std::function<bool(const ProbeFit&)>& counts);

}  // namespace pleinair::compositor
