#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

#include "tracker/alignment/block_sums.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// Whether light from beyond a marker is blurred into pixels that a fit uses. The quiet zone of a
/// small marker is narrower than the blur. `module_px`: module size in pixels of the window.
bool SurroundingsShow(double module_px, double blur_px);

/// Adds the marker's surroundings to a prediction whose quiet zone extends without limit. Each
/// pixel's share of light from beyond the marker gets the brightness observed a pixel or two
/// farther out. `lights`: light of the blocks; where it is unknown nothing is added.
void AddSurroundings(const MarkerPattern& pattern, const ObservedPatch& observed,
                     const PlaneMap& map, const std::vector<RowRange>& ranges, double blur_px,
                     const std::vector<BlockLight>& lights, int blocks_along,
                     PredictedImage* image);

}  // namespace pleinair::tracker
