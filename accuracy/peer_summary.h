#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <optional>
#include <string>
#include <vector>

#include "accuracy/summary.h"

namespace pleinair::accuracy {

/// The frames to compare: a sweep, or one recording.
struct PeerFrames {
  std::string sweep, film;
};

/// Compares our detector with another on the frames that both have processed; nullopt without any.
/// Neighbouring frames of videos have correlated errors: the bootstrap draws blocks of n^(1/3) of a
/// video's n frames (Carlstein 1986, "The use of subseries values for estimating the variance of a
/// general statistic from a stationary sequence"); for other sweeps it draws single frames.
std::optional<PeerSummary> CompareWithPeer(const std::vector<FrameRecord>& records,
                                           const PeerFrames& which, const std::string& ours,
                                           const std::string& peer);

}  // namespace pleinair::accuracy
