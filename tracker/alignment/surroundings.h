#pragma once

// Internal: between the .cc files of this module; not installed.

#include <vector>

#include "tracker/alignment/block_sums.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// Whether what lies beyond a marker is blurred into pixels that a fit looks at: the quiet zone of
/// small prints is narrower than the blur. `module_px`: of the window's pixels.
bool SurroundingsShow(double module_px, double blur_px);

/// Adds to a prediction, in which the quiet zone goes on for ever, what the image shows beyond
/// the marker: each pixel's share of light from there is of the brightness that is observed a pixel
/// or two farther out. `lights` are those of the blocks; where they are unknown nothing is added.
void AddSurroundings(const MarkerPattern& pattern, const ObservedPatch& observed,
                     const PlaneMap& map, const std::vector<RowRange>& ranges, double blur_px,
                     const std::vector<BlockLight>& lights, int blocks_along,
                     PredictedImage* image);

}  // namespace pleinair::tracker
