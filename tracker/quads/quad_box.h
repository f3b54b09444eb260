#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include "tracker/quads/dark_components.h"
#include "tracker/quads/quad_detector.h"

namespace pleinair::tracker {

/// True if a dark component of an image reduced `scale` times fills the bounding box of a square
/// that was already found. Most squares are found again at half size, and tracing their outlines is
/// the most expensive step. A component whose box differs by more than the thresholds remove at
/// corners may have a better outline, or be another square.
bool FillsBoxOf(const Quad& quad, const DarkComponent& component, int scale);

}  // namespace pleinair::tracker
