#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

#include "accuracy/summary.h"

namespace pleinair::accuracy {

/// Summaries of each recording with composed images, in the order of these, and of all recordings
/// if there are several.
std::vector<LightSummary> SummarizeLight(const std::vector<ImageRecord>& pictures);

}  // namespace pleinair::accuracy
