#pragma once
// Internal: between the .cc files of this module; not installed.

#include "tracker/quads/dark_components.h"
#include "tracker/quads/quad_detector.h"

namespace pleinair::tracker {

/// Whether a dark component of an image reduced `scale` times fills the box around a square that
/// has been found: most squares are found again at half size, and their outlines cost the most. A
/// component whose box differs by more than thresholds take off corners may be outlined better than
/// that square was, or be another.
bool FillsBoxOf(const Quad& quad, const DarkComponent& component, int scale);

}  // namespace pleinair::tracker
