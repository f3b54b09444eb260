#pragma once

#include <filesystem>
#include <vector>

#include "app/replay/replay_options.h"
#include "app/replay/report/report.h"
#include "base/error.h"

namespace pleinair::app {

/// Composites a recording into a folder: composite.mp4, frames/, poses/, detections.jsonl,
/// report.json, report.html, and the requested trajectory formats.
/// Makes three passes: markers, light, compositing. Reading, drawing and writing run in parallel,
/// with about twelve frames in memory. The result does not depend on the number of processors. All
/// outputs appear at the end; after an error there are none.
Result<ReplayReport> Replay(const ReplayOptions& options);

/// The files and folders that such a replay reads, models and their materials included, textures
/// not. Of a recording that cannot be opened, or has no scene, only those that the options name.
std::vector<std::filesystem::path> FilesReadBy(const ReplayOptions& options);

}  // namespace pleinair::app
