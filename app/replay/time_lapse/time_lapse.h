#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/replay/time_lapse/day_renderer.h"
#include "app/replay/time_lapse/moments.h"
#include "base/error.h"

namespace pleinair::app {

/// File names of a time-lapse in its folder.
inline constexpr const char* kTimeLapseVideo = "timelapse.mp4";
inline constexpr const char* kTimeLapseSheet = "timelapse.png";
inline constexpr const char* kTimeLapsePictures = "timelapse";  ///< Folder of 0000.png and so on.

/// The renderer of a time; it stays valid until the next call.
using RendererAt = std::function<Result<DayRenderer*>(UtcTime)>;

/// Draws the times of a day or of several. Writes the video and a contact sheet of some images with
/// their times or dates into a folder; with `pictures`, also every image. Shows a progress bar.
/// Returns the written names, relative. Errors: drawing, writing, "interrupted".
Result<std::vector<std::string>> WriteTimeLapse(const RendererAt& renderer_at,
                                                const TimeLapseMoments& moments,
                                                const Transform<Camera, Marker>& camera_from_marker,
                                                const std::filesystem::path& folder, bool pictures);

/// Returns the sheet and the video of a folder as a self-contained HTML fragment; empty if there is
/// no time-lapse. Errors: files that cannot be read.
Result<std::string> TimeLapseHtml(const std::filesystem::path& folder);

}  // namespace pleinair::app
