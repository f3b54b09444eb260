#pragma once
// Internal: between the .cc files of this module; not installed.

#include "tracker/surf/box_levels.h"

namespace pleinair::tracker {

/// Dominant direction of the picture around a keypoint (Bay et al. 2008, section 4.1), radians in
/// image axes (x right, y down): Haar wavelets of 4 s at the points of a grid of s within a circle
/// of 6 s, weighted with a Gaussian of 2 s; the window of pi/3 with the longest sum of responses
/// gives the direction. 0 where there is no gradient at all.
///
/// Deviations: a wavelet is made of four interpolated boxes of about 2 s, so that positions and
/// scales are not rounded to pixels; the window slides by 5 degrees over a histogram.
float DominantDirection(BoxLevels* levels, float x, float y, float scale);

}  // namespace pleinair::tracker
