#include "app/live/live_output.h"

#include <algorithm>
#include <utility>

#include "app/output/observed_trajectory.h"
#include "app/output/trajectory_export.h"
#include "base/atomic_file.h"

namespace pleinair::app {

LiveOutput::LiveOutput(Options options, const CameraModel& camera,
                       const scene::SceneDescription& scene, OutputFolder folder,
                       DetectionsWriter detections)
    : options_(std::move(options)),
      camera_(camera),
      scene_(scene),
      folder_(std::move(folder)),
      detections_(std::move(detections)) {}

Result<std::unique_ptr<LiveOutput>> LiveOutput::Create(const Options& options,
                                                       const CameraModel& camera,
                                                       const scene::SceneDescription& scene) {
  PLEINAIR_RETURN_IF_ERROR(CheckExports(options.exports, camera));
  PLEINAIR_ASSIGN_OR_RETURN(OutputFolder folder, OutputFolder::Create(options.folder));
  PLEINAIR_ASSIGN_OR_RETURN(DetectionsWriter detections,
                            DetectionsWriter::Create(folder.staging() / "detections.jsonl"));
  return std::unique_ptr<LiveOutput>(
      new LiveOutput(options, camera, scene, std::move(folder), std::move(detections)));
}

Result<void> LiveOutput::Add(const session::MarkerTracks& marker_tracks, std::int64_t frame_index,
                             std::int64_t timestamp_ns, const std::string& line) {
  frames_.emplace_back(frame_index, timestamp_ns);
  for (const auto& [marker, observations] : marker_tracks.tracks()) {
    if (observations.empty() || observations.back().frame_index != frame_index) continue;
    // Poses count from the start of the recording, as the time of the line does.
    exports::TrajectoryPose pose = ObservedPose(observations.back());
    pose.timestamp_ns = timestamp_ns;
    paths_[marker].poses.push_back(std::move(pose));
  }
  if (options_.exports.contains(exports::TrajectoryFormat::kMcap))
    markers_seen_.push_back({timestamp_ns, line});
  return detections_.Add(line);
}

Result<void> LiveOutput::Finish(UtcTime start, const std::vector<LightRow>& light) {
  auto written = Write(start, light);
  if (!written) return tl::make_unexpected(folder_.InTermsOfTarget(written.error()));
  return written;
}

Result<void> LiveOutput::Write(UtcTime start, const std::vector<LightRow>& light) {
  PLEINAIR_RETURN_IF_ERROR(detections_.Finish());
  if (!light.empty()) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(folder_.staging() / "light.csv",
                                                 LightCsv(WithMissingFrames(light, frames_))));
  }
  PLEINAIR_RETURN_IF_ERROR(folder_.MakeFolder("poses"));
  exports::CameraTrajectory reference_markers;
  for (const auto& [marker, path] : paths_) {
    PLEINAIR_RETURN_IF_ERROR(
        WriteMarkerTrajectory(marker, path, options_.exports, folder_.staging()).map([](auto) {}));
    if (session::MayBeReferenceMarker(marker, scene_.marker) &&
        path.poses.size() > reference_markers.poses.size()) {
      reference_markers = path;
    }
  }
  scene_.place_time.start = start;
  reference_markers.camera = camera_;
  PLEINAIR_RETURN_IF_ERROR(
      ExportTrajectory({std::move(reference_markers), scene_, std::move(markers_seen_)},
                       options_.exports, folder_.staging())
          .map([](const auto&) {}));
  return folder_.Commit();
}

}  // namespace pleinair::app
