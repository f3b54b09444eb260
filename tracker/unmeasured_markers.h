#pragma once

#include <optional>
#include <vector>

#include "tracker/marker_detector.h"
#include "tracker/refinement/marker_alignment.h"

namespace pleinair::tracker {

/// What the detectors found in one picture, between the parts of Tracker::Track().
struct UnmeasuredMarkers {
  std::vector<Candidate> candidates;
  /// By candidate; nothing where the detector measured the corners itself, or where the picture
  /// does not bear the alignment out.
  std::vector<std::optional<MarkerAlignment>> alignments;
};

}  // namespace pleinair::tracker
