#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// The number that OpenCV's aruco module has for a dictionary such as "4x4_50", "aruco_original"
/// and "apriltag_36h11"; capitals and "DICT_" do not matter. Errors (input): unknown, with the
/// known ones; fewer than `markers` in it.
Result<int> FindDictionary(const std::string& name);
Result<void> CheckDictionary(const std::string& name, int markers);

/// One dictionary for each kind of code, the smallest that has so many markers: the first codes of
/// "4x4_50" are those of "4x4_1000".
std::vector<std::string> DictionariesFor(int markers);

/// What marker `id` looks like: its black rim is one module wide, and no quiet zone is included.
/// Errors as FindDictionary, and an id that it does not have.
Result<MarkerPattern> ArucoMarkerPattern(const std::string& dictionary, int id);

}  // namespace pleinair::tracker
