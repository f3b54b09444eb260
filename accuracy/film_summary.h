#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

#include "accuracy/summary.h"

namespace pleinair::accuracy {

/// Summaries of every level and pattern of the sweep "jitter" with at least five hits.
std::vector<JitterSummary> SummarizeJitter(const std::vector<FrameRecord>& records);

/// Summaries of the sweeps whose names begin with "sequence", and of every recording.
std::vector<FilmSummary> SummarizeFilms(const std::vector<FrameRecord>& records);

}  // namespace pleinair::accuracy
