#include "app/output/trajectory_export.h"

#include <utility>

#include "app/output/observed_trajectory.h"
#include "app/output/pose_sources.h"
#include "base/atomic_file.h"
#include "export/trajectories/colmap_folder.h"

namespace pleinair::app {

Result<void> CheckExports(const std::set<exports::TrajectoryFormat>& formats,
                          const CameraModel& camera) {
  if (formats.contains(exports::TrajectoryFormat::kColmap) &&
      formats.contains(exports::TrajectoryFormat::kColmapBinary)) {
    return InputError("--export", "colmap and colmap-binary are one model in two forms",
                      "leave one of them out");
  }
  if (!formats.contains(exports::TrajectoryFormat::kGltf) ||
      camera.distortion_model != DistortionModel::kEquidistant) {
    return {};
  }
  return InputError("--export", "a glTF camera is perspective, but the lens is a fisheye",
                    "undistort the images and calibrate those, or leave gltf out");
}

Result<std::vector<std::string>> WriteMarkerTrajectory(
    const session::MarkerName& marker, const exports::CameraTrajectory& path,
    const std::set<exports::TrajectoryFormat>& formats, const std::filesystem::path& folder) {
  std::vector<std::string> outputs;
  for (const exports::TrajectoryFormat format :
       {exports::TrajectoryFormat::kTum, exports::TrajectoryFormat::kEuroc}) {
    if (format == exports::TrajectoryFormat::kEuroc && !formats.contains(format)) continue;
    const std::string name = "poses/" + marker.ToString() +
                             (format == exports::TrajectoryFormat::kTum ? ".tum" : ".csv");
    PLEINAIR_RETURN_IF_ERROR(exports::WriteTrajectory(path, folder / name, format,
                                                      {.comment = kObservedTrajectoryComment}));
    outputs.push_back(name);
  }
  return outputs;
}

Result<std::vector<std::string>> WriteGivenTrajectory(const std::vector<session::Observation>& path,
                                                      const std::filesystem::path& folder) {
  PLEINAIR_RETURN_IF_ERROR(exports::WriteTrajectory(
      ObservedTrajectory(path), folder / "poses/trajectory.tum", exports::TrajectoryFormat::kTum,
      {.comment = kObservedTrajectoryComment}));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(folder / "poses/sources.csv", PoseSourcesCsv(path)));
  return std::vector<std::string>{"poses/trajectory.tum", "poses/sources.csv"};
}

Result<std::vector<std::string>> ExportTrajectory(
    TrajectoryExport what, const std::set<exports::TrajectoryFormat>& formats,
    const std::filesystem::path& folder) {
  std::vector<std::string> outputs;
  const exports::CameraTrajectory& path = what.path;
  const scene::MarkerDescription& marker = what.scene.marker;
  const exports::UpAxis up = marker.upright ? exports::UpAxis::kY : exports::UpAxis::kZ;
  const exports::TrajectoryWriting writing{.up = up, .marker_size_m = marker.size_m};
  if (formats.contains(exports::TrajectoryFormat::kGltf) && !path.poses.empty()) {
    PLEINAIR_RETURN_IF_ERROR(exports::WriteTrajectory(path, folder / "camera.glb",
                                                      exports::TrajectoryFormat::kGltf, writing));
    outputs.emplace_back("camera.glb");
  }
  for (const auto& [format, form] :
       {std::pair(exports::TrajectoryFormat::kColmap, exports::ColmapForm::kText),
        std::pair(exports::TrajectoryFormat::kColmapBinary, exports::ColmapForm::kBinary)}) {
    if (!formats.contains(format) || path.poses.empty()) continue;
    PLEINAIR_RETURN_IF_ERROR(exports::WriteTrajectory(path, folder / "colmap", format, writing));
    for (const char* name : exports::ColmapFileNames(form))
      outputs.push_back(std::string("colmap/") + name);
  }
  if (formats.contains(exports::TrajectoryFormat::kMcap)) {
    exports::McapTrajectoryOptions mcap;
    mcap.start_ns = what.scene.place_time.start.nanoseconds_since_1970();
    mcap.marker_size_m = marker.size_m;
    mcap.markers = std::move(what.markers);
    auto bytes = exports::McapFromTrajectory(path, mcap);
    if (!bytes) {
      Error error = std::move(bytes).error();
      error.where = what.scene.file.string();
      return tl::make_unexpected(std::move(error));
    }
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(folder / "camera.mcap", *bytes));
    outputs.emplace_back("camera.mcap");
  }
  return outputs;
}

}  // namespace pleinair::app
