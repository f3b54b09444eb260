#pragma once

#include "base/vector.h"

namespace pleinair::compositor {

/// Open light over that on a marker which leaves shade, each channel: shade is not only darker but
/// bluer. The marker has the sky and a part of the sun, so much that the mean logarithm of the
/// channels is that of `sunlit_scale`, what surfaces in the open tell
/// (compositor/photometry/shade/sunlit_levels.h). `sun`, `sky`: on the marker in the open, linear
/// Rec.709, any unit.
///
/// Where a marker without any sun would still be brighter than `sunlit_scale` says, the crowns take
/// of the sky, or `sun` over `sky` is too low: things in the open lack nothing then, things beside
/// the marker do, so that half of the rest counts (its root), in all channels alike. Ours, without
/// a source: which of the two it is cannot be told. 1 without a sun, and from `sunlit_scale` 1
/// down.
LinearRgb MarkerShadeCorrection(double sunlit_scale, LinearRgb sun, LinearRgb sky);

}  // namespace pleinair::compositor
