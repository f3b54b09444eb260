#pragma once

#include <cstdint>

#include "app/check/site_findings.h"

namespace pleinair::app {

/// Judges whether a scene's trajectory fits the film. Bad: it has no pose for the frames, or
/// contradicts the marker. Doubtful: it fits the marker badly, is tilted, or the offset of its
/// clock is assumed. Doubtful, too: it has no pose for more than a tenth of the `looked_at` frames.
/// Not checked: no frame shows the marker.
SiteFinding TrajectoryFinding(const TrajectoryFit& fit, std::int64_t looked_at);

}  // namespace pleinair::app
