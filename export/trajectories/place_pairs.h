#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// A place in a trajectory's frame of reference and in the marker's, to align the two.
struct PlacePair {
  Point<Reference> in_trajectory;  ///< In the trajectory's unit of length.
  Point<Marker> in_scene;          ///< Metres.
};

/// Parses places that align a trajectory. A line has six numbers: X Y Z in its frame of reference,
/// then x y z in the marker's, metres. Separated by blanks, tabs or commas; comments start with
/// '#'. Errors: fewer than three places or more than 10,000, malformed lines, coordinates beyond
/// 1e6.
Result<std::vector<PlacePair>> ParsePlacePairs(std::string_view text, const std::string& name);

}  // namespace pleinair::exports
