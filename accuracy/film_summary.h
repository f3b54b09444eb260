#pragma once

// Internal: between the .cc files of this module; not installed.

#include <vector>

#include "accuracy/summary.h"

namespace pleinair::accuracy {

/// Of every level and pattern of the sweep "jitter" with at least five hits.
std::vector<JitterSummary> SummarizeJitter(const std::vector<FrameRecord>& records);

/// Of the sweeps whose names begin with "sequence" and of every recording.
std::vector<FilmSummary> SummarizeFilms(const std::vector<FrameRecord>& records);

}  // namespace pleinair::accuracy
