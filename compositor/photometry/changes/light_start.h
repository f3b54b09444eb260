#pragma once

// Internal: between .cc files.

#include <cstddef>
#include <vector>

#include "compositor/photometry/changes/light_walk.h"
#include "compositor/photometry/changes/probe_fit.h"

namespace pleinair::compositor {

/// Where the fit of the light begins.
struct LightStart {
  std::vector<std::size_t> reference;  ///< Frames in full sun, with enough readings.
  std::vector<LogLight> light;         ///< By frame; 0 is the usual light of the reference.
};

/// Every frame's light by the brightness of its probes in the sun and of those in shade, as
/// modelled: the sun and the sky that explain both. Without a `reference` its frames are those with
/// the deepest shadows.
LightStart StartLight(const std::vector<ProbeFit>& probes, std::size_t frame_count,
                      std::vector<std::size_t> reference);

}  // namespace pleinair::compositor
