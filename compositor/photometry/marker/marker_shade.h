#pragma once

#include "base/vector.h"

namespace pleinair::compositor {

/// Open light over that on a print which leaves shade, each channel: shade is not only darker but
/// bluer. The print has the sky and a part of the sun, so much that the mean logarithm of the
/// channels is that of `open_gain`, what surfaces in the open tell
/// (compositor/photometry/shade/sunlit_levels.h). `sun`, `sky`: on the print in the open, linear
/// Rec.709, any unit.
///
/// Where a print without any sun would still be brighter than `open_gain` says, the crowns take of
/// the sky, or `sun` over `sky` is too low: things in the open lack nothing then, things beside the
/// print do, so that half of the rest counts (its root), in all channels alike. Ours, without a
/// source: which of the two it is cannot be told. 1 without a sun, and from `open_gain` 1 down.
LinearRgb PrintShade(double open_gain, LinearRgb sun, LinearRgb sky);

}  // namespace pleinair::compositor
