#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/output/detections_writer.h"
#include "app/output/light_csv.h"
#include "app/output/output_folder.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "export/trajectories/camera_trajectory.h"
#include "export/trajectories/mcap_trajectory.h"
#include "export/trajectories/trajectory_files.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// Writes the observations of a live session in the file formats of replay: detections.jsonl,
/// light.csv, poses/MARKER.tum and other trajectory formats. All files appear when the session
/// ends. Trajectories stay in memory until then: about 140 bytes per frame and marker, 15 MB per
/// hour at 30 Hz. Each frame takes 16 bytes more. For MCAP, each frame's line of detections.jsonl
/// stays in memory, too.
class LiveOutput {
 public:
  struct Options {
    std::filesystem::path folder;
    std::set<exports::TrajectoryFormat> exports;  ///< In addition to TUM.
  };

  /// Errors: as OutputFolder; a lens model that a format cannot store.
  static Result<std::unique_ptr<LiveOutput>> Create(const Options& options,
                                                    const CameraModel& camera,
                                                    const scene::SceneDescription& scene);

  /// Adds a newly tracked frame and its line of detections.jsonl.
  Result<void> Add(const session::MarkerTracks& marker_tracks, std::int64_t frame_index,
                   std::int64_t timestamp_ns, const std::string& line);

  /// Writes the trajectories and the light of the drawn frames, and commits all files. `start`: UTC
  /// of the first frame.
  Result<void> Finish(UtcTime start, const std::vector<LightRow>& light);

 private:
  LiveOutput(Options options, const CameraModel& camera, const scene::SceneDescription& scene,
             OutputFolder folder, DetectionsWriter detections);
  Result<void> Write(UtcTime start, const std::vector<LightRow>& light);

  Options options_;
  CameraModel camera_;
  scene::SceneDescription scene_;
  OutputFolder folder_;
  DetectionsWriter detections_;
  std::map<session::MarkerName, exports::CameraTrajectory> paths_;
  std::vector<std::pair<std::int64_t, std::int64_t>> frames_;  // Index and time stamp.
  std::vector<exports::MarkersMessage> markers_seen_;          // Only for MCAP.
};

}  // namespace pleinair::app
