#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/output/detections_writer.h"
#include "app/output/output_folder.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "export/trajectories/camera_trajectory.h"
#include "export/trajectories/mcap_trajectory.h"
#include "export/trajectories/trajectory_files.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// What a live session saw, in the files that replay writes of a recording: detections.jsonl,
/// poses/MARKER.tum and other forms of the path. All of them appear when the session ends. Paths
/// are kept in memory until then: some 140 bytes a frame and marker, 15 MB an hour at 30 Hz; for
/// MCAP each frame's line of detections.jsonl, too.
class LiveOutput {
 public:
  struct Options {
    std::filesystem::path folder;
    std::set<exports::TrajectoryFormat> exports;  ///< Besides TUM.
  };

  /// Errors: of OutputFolder; a lens that a form cannot hold.
  static Result<std::unique_ptr<LiveOutput>> Create(const Options& options,
                                                    const CameraModel& camera,
                                                    const scene::SceneDescription& scene);

  /// Adds a frame that the session has just taken in, and its line of detections.jsonl.
  Result<void> Add(const session::MarkerTracks& marker_tracks, std::int64_t frame_index,
                   std::int64_t timestamp_ns, const std::string& line);

  /// Writes the paths and moves everything to its place. `start`: of the first frame.
  Result<void> Finish(UtcTime start);

 private:
  LiveOutput(Options options, const CameraModel& camera, const scene::SceneDescription& scene,
             OutputFolder folder, DetectionsWriter detections);
  Result<void> Write(UtcTime start);

  Options options_;
  CameraModel camera_;
  scene::SceneDescription scene_;
  OutputFolder folder_;
  DetectionsWriter detections_;
  std::map<session::MarkerName, exports::CameraTrajectory> paths_;
  std::vector<exports::MarkersMessage> markers_seen_;  // For MCAP alone.
};

}  // namespace pleinair::app
