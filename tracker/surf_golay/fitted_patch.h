#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/observed_patch.h"

namespace pleinair::tracker {

/// An image patch and the fit of a marker to it. Buffers are reused from fit to fit.
struct FittedPatch {
  ObservedPatch observed;
  BlockFit fit;
};

}  // namespace pleinair::tracker
