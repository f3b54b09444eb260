#pragma once

// Internal: between the .cc files of this module; not installed.

#include <optional>
#include <string>
#include <vector>

#include "accuracy/summary.h"

namespace pleinair::accuracy {

/// Ours against a peer in the frames of one sweep that both have seen; nothing without any.
std::optional<PeerSummary> CompareWithPeer(const std::vector<FrameRecord>& records,
                                           const std::string& sweep, const std::string& ours,
                                           const std::string& peer);

}  // namespace pleinair::accuracy
