#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/paths/mcap_path.h"
#include "app/paths/path_files.h"
#include "app/sinks/report.h"
#include "base/camera_model.h"
#include "devices/scene_description.h"

namespace pleinair::app {

/// What replay's frames were taken with and show, for the forms of other programs.
struct PathExport {
  const ReplayReport& report;
  const devices::SceneDescription& scene;
  CameraModel camera;                   ///< Of the frames that replay writes.
  std::vector<MarkersMessage> markers;  ///< For MCAP alone: what was seen, frame by frame.
};

/// Error: a lens that a form cannot hold; found before a long search for markers.
Result<void> CheckExports(const std::set<PathFormat>& formats, const CameraModel& camera);

/// Writes the anchor's path into a folder, `camera.glb`, `colmap/` or `camera.mcap`; gives their
/// names. MCAP holds what was seen even where the anchor never was, the others are left out then.
/// (`euroc` is not an affair of this: poses of every marker lie in poses/.)
Result<std::vector<std::string>> ExportPath(const PathExport& what,
                                            const std::set<PathFormat>& formats,
                                            const std::filesystem::path& folder);

}  // namespace pleinair::app
