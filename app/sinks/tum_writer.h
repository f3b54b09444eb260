#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/session.h"
#include "base/error.h"

namespace pleinair::app {

/// The camera's path in the marker frame, a line a frame: `timestamp tx ty tz qx qy qz qw`, seconds
/// since the recording's start, metres, Hamilton quaternion of the camera's axes with qw >= 0
/// (TUM RGB-D benchmark's trajectory form).
std::string TumText(const std::vector<Observation>& path);

Result<void> WriteTum(const std::filesystem::path& file, const std::vector<Observation>& path);

}  // namespace pleinair::app
