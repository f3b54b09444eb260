#include "app/output/path_export.h"

#include <utility>

#include "app/output/observed_path.h"
#include "base/atomic_file.h"
#include "export/trajectories/colmap_folder.h"

namespace pleinair::app {

Result<void> CheckExports(const std::set<exports::PathFormat>& formats, const CameraModel& camera) {
  if (formats.contains(exports::PathFormat::kColmap) &&
      formats.contains(exports::PathFormat::kColmapBinary)) {
    return InputError("--export", "colmap and colmap-binary are one model in two forms",
                      "leave one of them out");
  }
  if (!formats.contains(exports::PathFormat::kGltf) ||
      camera.distortion_model != DistortionModel::kEquidistant) {
    return {};
  }
  return InputError("--export", "a glTF camera is a perspective one, and the lens a fisheye",
                    "undistort the pictures and calibrate those, or leave gltf out");
}

Result<std::vector<std::string>> WriteMarkerPath(const session::MarkerName& marker,
                                                 const exports::CameraPath& path,
                                                 const std::set<exports::PathFormat>& formats,
                                                 const std::filesystem::path& folder) {
  std::vector<std::string> outputs;
  for (const exports::PathFormat format :
       {exports::PathFormat::kTum, exports::PathFormat::kEuroc}) {
    if (format == exports::PathFormat::kEuroc && !formats.contains(format)) continue;
    const std::string name =
        "poses/" + marker.ToString() + (format == exports::PathFormat::kTum ? ".tum" : ".csv");
    PLEINAIR_RETURN_IF_ERROR(
        exports::WritePath(path, folder / name, format, {.comment = kObservedPathComment}));
    outputs.push_back(name);
  }
  return outputs;
}

Result<std::vector<std::string>> ExportPath(PathExport what,
                                            const std::set<exports::PathFormat>& formats,
                                            const std::filesystem::path& folder) {
  std::vector<std::string> outputs;
  const exports::CameraPath& path = what.path;
  const scene::MarkerDescription& marker = what.scene.marker;
  const exports::UpAxis up = marker.upright ? exports::UpAxis::kY : exports::UpAxis::kZ;
  const exports::PathWriting writing{.up = up, .marker_size_m = marker.size_m};
  if (formats.contains(exports::PathFormat::kGltf) && !path.poses.empty()) {
    PLEINAIR_RETURN_IF_ERROR(
        exports::WritePath(path, folder / "camera.glb", exports::PathFormat::kGltf, writing));
    outputs.emplace_back("camera.glb");
  }
  for (const auto& [format, form] :
       {std::pair(exports::PathFormat::kColmap, exports::ColmapForm::kText),
        std::pair(exports::PathFormat::kColmapBinary, exports::ColmapForm::kBinary)}) {
    if (!formats.contains(format) || path.poses.empty()) continue;
    PLEINAIR_RETURN_IF_ERROR(exports::WritePath(path, folder / "colmap", format, writing));
    for (const char* name : exports::ColmapFileNames(form))
      outputs.push_back(std::string("colmap/") + name);
  }
  if (formats.contains(exports::PathFormat::kMcap)) {
    exports::McapPathOptions mcap;
    mcap.start_ns = what.scene.place_time.start.nanoseconds_since_1970();
    mcap.marker_size_m = marker.size_m;
    mcap.markers = std::move(what.markers);
    auto bytes = exports::McapFromPath(path, mcap);
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
