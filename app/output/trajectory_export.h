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

/// Data for the trajectory formats of other programs.
struct TrajectoryExport {
  exports::CameraTrajectory path;  ///< Reference marker's trajectory, with the output camera.
  const scene::SceneDescription& scene;
  std::vector<exports::MarkersMessage> markers;  ///< Only for MCAP: observations, frame by frame.
};

/// Checks the formats before the long detection pass. Errors: a lens model that a format cannot
/// store, a repeated format.
Result<void> CheckExports(const std::set<exports::TrajectoryFormat>& formats,
                          const CameraModel& camera);

/// Writes a marker's trajectory into the folder `poses` in `folder`: MARKER.tum and, if `euroc` is
/// requested, MARKER.csv. Returns the names.
Result<std::vector<std::string>> WriteMarkerTrajectory(
    const session::MarkerName& marker, const exports::CameraTrajectory& path,
    const std::set<exports::TrajectoryFormat>& formats, const std::filesystem::path& folder);

/// Writes a trajectory that follows a given one: poses/trajectory.tum, and poses/sources.csv with
/// the source of each pose. Returns the names.
Result<std::vector<std::string>> WriteGivenTrajectory(const std::vector<session::Observation>& path,
                                                      const std::filesystem::path& folder);

/// Writes the reference marker's trajectory into a folder as `camera.glb`, `colmap/` or
/// `camera.mcap`, and returns the names. Without observations of the reference marker only MCAP is
/// written, with the observations of other markers. WriteMarkerTrajectory writes `euroc`.
Result<std::vector<std::string>> ExportTrajectory(
    TrajectoryExport what, const std::set<exports::TrajectoryFormat>& formats,
    const std::filesystem::path& folder);

}  // namespace pleinair::app
