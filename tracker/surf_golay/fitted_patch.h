#pragma once

// Internal: between the .cc files of this module; not installed.

#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/observed_patch.h"

namespace pleinair::tracker {

/// A patch of an image and the fit of a marker to it. Both keep their buffers from fit to fit.
struct FittedPatch {
  ObservedPatch observed;
  BlockFit fit;
};

}  // namespace pleinair::tracker
