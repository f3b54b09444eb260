#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include "tracker/surf/box_levels.h"
#include "tracker/surf/surf_descriptor.h"
#include "tracker/surf/surf_keypoint.h"

namespace pleinair::tracker {

/// The descriptor of a keypoint at its angle (Bay et al. 2008, section 4.2): 20 x 20 samples over a
/// window of `window_scales` s (20 in the paper), Haar wavelets of 2 s weighted with a Gaussian of
/// 3.3 s. Samples, wavelets and Gaussian scale with the window.
///
/// Deviations: the paper uses upright wavelets and rotates their responses; here a wavelet consists
/// of four upright boxes of about s at rotated corners, interpolated between pixels. The paper
/// assigns a sample to one cell; here it is shared between the nearest cells by distance from their
/// centres, which gives 2 % more correct matches (docs/measurements/surf.md).
SurfDescriptor DescribeKeypoint(BoxLevels* levels, const SurfKeypoint& keypoint,
                                float window_scales);

}  // namespace pleinair::tracker
