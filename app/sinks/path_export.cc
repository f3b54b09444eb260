#include "app/sinks/path_export.h"

#include <utility>

#include "app/paths/colmap_folder.h"
#include "app/paths/observed_path.h"
#include "base/atomic_file.h"

namespace pleinair::app {

Result<void> CheckExports(const std::set<PathFormat>& formats, const CameraModel& camera) {
  if (formats.contains(PathFormat::kColmap) && formats.contains(PathFormat::kColmapBinary)) {
    return InputError("--export", "colmap and colmap-binary are one model in two forms",
                      "leave one of them out");
  }
  if (!formats.contains(PathFormat::kGltf) ||
      camera.distortion_model != DistortionModel::kEquidistant) {
    return {};
  }
  return InputError("--export", "a glTF camera is a perspective one, and the lens a fisheye",
                    "undistort the pictures and calibrate those, or leave gltf out");
}

Result<std::vector<std::string>> WriteMarkerPath(const session::MarkerName& marker,
                                                 const CameraPath& path,
                                                 const std::set<PathFormat>& formats,
                                                 const std::filesystem::path& folder) {
  std::vector<std::string> outputs;
  for (const PathFormat format : {PathFormat::kTum, PathFormat::kEuroc}) {
    if (format == PathFormat::kEuroc && !formats.contains(format)) continue;
    const std::string name =
        "poses/" + marker.ToString() + (format == PathFormat::kTum ? ".tum" : ".csv");
    PLEINAIR_RETURN_IF_ERROR(
        WritePath(path, folder / name, format, {.comment = kObservedPathComment}));
    outputs.push_back(name);
  }
  return outputs;
}

Result<std::vector<std::string>> ExportPath(PathExport what, const std::set<PathFormat>& formats,
                                            const std::filesystem::path& folder) {
  std::vector<std::string> outputs;
  const CameraPath& path = what.path;
  const scene::MarkerDescription& marker = what.scene.marker;
  const UpAxis up = marker.upright ? UpAxis::kY : UpAxis::kZ;
  const PathWriting writing{.up = up, .marker_size_m = marker.size_m};
  if (formats.contains(PathFormat::kGltf) && !path.poses.empty()) {
    PLEINAIR_RETURN_IF_ERROR(WritePath(path, folder / "camera.glb", PathFormat::kGltf, writing));
    outputs.emplace_back("camera.glb");
  }
  for (const auto& [format, form] : {std::pair(PathFormat::kColmap, ColmapForm::kText),
                                     std::pair(PathFormat::kColmapBinary, ColmapForm::kBinary)}) {
    if (!formats.contains(format) || path.poses.empty()) continue;
    PLEINAIR_RETURN_IF_ERROR(WritePath(path, folder / "colmap", format, writing));
    for (const char* name : ColmapFileNames(form)) outputs.push_back(std::string("colmap/") + name);
  }
  if (formats.contains(PathFormat::kMcap)) {
    McapPathOptions mcap;
    mcap.start_ns = what.scene.place_time.start.nanoseconds_since_1970();
    mcap.marker_size_m = marker.size_m;
    mcap.markers = std::move(what.markers);
    auto bytes = McapFromPath(path, mcap);
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
