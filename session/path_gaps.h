#pragma once

// Internal: not installed.

#include <cstdint>
#include <vector>

#include "session/marker_tracks.h"

namespace pleinair::session {

/// Gaps of a trajectory that were filled.
struct FilledGaps {
  std::int64_t frames = 0, gaps = 0;
  double longest_s = 0.0;  ///< From the last pose before to the first one after.
};

/// Longest gap that is filled, from the last pose before it to the first one after it. Within half
/// a second, people who film by hand turn and sway little beyond what the poses around it show.
inline constexpr double kMaxGap_s = 0.5;

/// Fills the gaps of a trajectory by the camera's motion between the poses at their ends
/// (PathMotion). `times`: all frames of the recording.
FilledGaps FillGaps(const std::vector<FrameTime>& times, std::vector<Observation>* path);

}  // namespace pleinair::session
