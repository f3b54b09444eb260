#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/replay/time_lapse/day_renderer.h"
#include "app/replay/time_lapse/moments.h"
#include "base/error.h"

namespace pleinair::app {

/// What a time-lapse leaves in a folder.
inline constexpr const char* kTimeLapseVideo = "timelapse.mp4";
inline constexpr const char* kTimeLapseSheet = "timelapse.png";
inline constexpr const char* kTimeLapsePictures = "timelapse";  ///< Folder of 0000.png and so on.

/// Draws the moments of a day and writes the video and a sheet of some of them, with their times,
/// into a folder; with `pictures` each of them too. Shows a bar. Returns the names written,
/// relative. Errors: drawing, writing, "interrupted".
Result<std::vector<std::string>> WriteTimeLapse(DayRenderer& renderer,
                                                const TimeLapseMoments& moments,
                                                const Transform<Camera, Marker>& camera_from_marker,
                                                const std::filesystem::path& folder, bool pictures);

/// The sheet and the video of a folder, as part of a page that needs no other file; empty where
/// there is no time-lapse. Errors: files that cannot be read.
Result<std::string> TimeLapseHtml(const std::filesystem::path& folder);

}  // namespace pleinair::app
