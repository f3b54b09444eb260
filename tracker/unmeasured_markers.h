#pragma once

#include <optional>
#include <vector>

#include "tracker/marker_detector.h"
#include "tracker/refinement/marker_alignment.h"

namespace pleinair::tracker {

/// Detections of one image, passed between the parts of Tracker::Track().
struct UnmeasuredMarkers {
  std::vector<Candidate> candidates;
  /// One per candidate; unset if the detector measured the corners itself, or if the alignment
  /// failed.
  std::vector<std::optional<MarkerAlignment>> alignments;
};

}  // namespace pleinair::tracker
