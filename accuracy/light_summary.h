#pragma once

// Internal: between the .cc files of this module; not installed.

#include <vector>

#include "accuracy/summary.h"

namespace pleinair::accuracy {

/// Of each recording with composed pictures, in the order of these, and of all recordings where
/// there are several.
std::vector<LightSummary> SummarizeLight(const std::vector<ImageRecord>& pictures);

}  // namespace pleinair::accuracy
