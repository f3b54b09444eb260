#pragma once

// Internal: between the .cc files of this module; not installed.

#include <optional>
#include <string>
#include <vector>

#include "accuracy/summary.h"

namespace pleinair::accuracy {

/// Frames that are compared: a sweep, of recordings perhaps one only.
struct PeerFrames {
  std::string sweep, film;
};

/// Ours against a peer in the frames that both have seen; nothing without any. Neighbouring frames
/// of films err alike: the bootstrap draws blocks of n^(1/3) of a film's n frames (Carlstein 1986,
/// "The use of subseries values for estimating the variance of a general statistic from a
/// stationary sequence"), of other sweeps single frames.
std::optional<PeerSummary> CompareWithPeer(const std::vector<FrameRecord>& records,
                                           const PeerFrames& which, const std::string& ours,
                                           const std::string& peer);

}  // namespace pleinair::accuracy
