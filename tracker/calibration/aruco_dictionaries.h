#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// Index in OpenCV's aruco module of a dictionary such as "4x4_50", "aruco_original" or
/// "apriltag_36h11"; case and a "DICT_" prefix are ignored. Errors (input): unknown name (the
/// message lists the known ones); fewer than `markers` markers in it.
Result<int> FindDictionary(const std::string& name);
Result<void> CheckDictionary(const std::string& name, int markers);

/// One dictionary per code size, the smallest that has at least `markers` markers. (The first codes
/// of "4x4_50" are those of "4x4_1000".)
std::vector<std::string> DictionariesFor(int markers);

/// Bit pattern of marker `id`: its black border is one module wide; no quiet zone is included.
/// Errors: as FindDictionary(), and an id that the dictionary does not have.
Result<MarkerPattern> ArucoMarkerPattern(const std::string& dictionary, int id);

}  // namespace pleinair::tracker
