#pragma once

#include "base/vector.h"

namespace pleinair::compositor {

/// Ratio of direct sunlight to the light on a marker that leaves shade, per channel. Shade is not
/// only darker but bluer.
///
/// The ratio is (sun + sky) / (part × sun + sky). `part` is chosen so that the mean logarithm of
/// the channels is that of `sunlit_scale`. `sunlit_scale` comes from surfaces in direct sunlight
/// (compositor/photometry/shade/sunlit_levels.h). `sun` and `sky` are the light on the unshaded
/// marker, linear Rec.709, any unit. The result is 1 without a sun and for a `sunlit_scale` of 1 or
/// less.
///
/// A marker without any sun may still be brighter than `sunlit_scale` requires. Then either the
/// crowns occlude a part of the sky, or `sun` over `sky` is too low. Surfaces in direct sunlight
/// lack no light then, but surfaces beside the marker do. Therefore the root of the remaining ratio
/// is applied to all channels alike. This is ours, without a source: the two causes cannot be
/// separated.
LinearRgb MarkerShadeCorrection(double sunlit_scale, LinearRgb sun, LinearRgb sky);

}  // namespace pleinair::compositor
