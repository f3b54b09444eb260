#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "export/trajectories/mcap_trajectory.h"
#include "export/trajectories/trajectory_files.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// What frames were taken with and show, for the forms of other programs.
struct TrajectoryExport {
  exports::CameraTrajectory
      path;  ///< Of the reference marker, with the camera of the frames that are written.
  const scene::SceneDescription& scene;
  std::vector<exports::MarkersMessage> markers;  ///< For MCAP alone: what was seen, frame by frame.
};

/// Errors: a lens that a form cannot hold, a form twice; found before a long search for markers.
Result<void> CheckExports(const std::set<exports::TrajectoryFormat>& formats,
                          const CameraModel& camera);

/// Writes a marker's path into the folder `poses` in `folder`, as MARKER.tum and, where `euroc` is
/// asked for, as MARKER.csv; gives their names.
Result<std::vector<std::string>> WriteMarkerTrajectory(
    const session::MarkerName& marker, const exports::CameraTrajectory& path,
    const std::set<exports::TrajectoryFormat>& formats, const std::filesystem::path& folder);

/// Writes the reference marker's path into a folder, `camera.glb`, `colmap/` or `camera.mcap`;
/// gives their names. MCAP holds what was seen even where the reference marker never was, the
/// others are left out then.
/// (`euroc` is WriteMarkerTrajectory's affair.)
Result<std::vector<std::string>> ExportTrajectory(
    TrajectoryExport what, const std::set<exports::TrajectoryFormat>& formats,
    const std::filesystem::path& folder);

}  // namespace pleinair::app
