#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/error.h"
#include "devices/recordings/euroc.h"
#include "export/trajectories/camera_path.h"
#include "export/trajectories/frames_of_others.h"

namespace pleinair::exports {

/// Forms that a camera's path has in files.
enum class PathFormat { kTum, kEuroc, kColmap, kColmapBinary, kGltf, kMcap };

/// By name: "tum", "euroc", "colmap", "colmap-binary", "gltf", "mcap"; nothing for others.
std::optional<PathFormat> PathFormatNamed(const std::string& name);

/// By a file's name: .tum and .txt TUM, .csv EuRoC, .glb and .gltf glTF, .mcap MCAP; a folder or a
/// name without extension is a COLMAP model. Errors: other names.
Result<PathFormat> PathFormatOf(const std::filesystem::path& file);

struct PathReading {
  double frame_rate_hz = 0.0;  ///< For COLMAP, which knows no times; 0: nobody said.
  Transform<devices::EurocBody, Camera> body_from_camera{};
};

/// Reads TUM, EuRoC or COLMAP, this in the form that the folder has. Errors: what their parsers
/// refuse, forms that are only written.
Result<CameraPath> ReadPath(const std::filesystem::path& file, PathFormat format,
                            const PathReading& options);

struct PathWriting {
  std::string comment = "camera in its reference";  ///< What TUM lines are headed with.
  UpAxis up = UpAxis::kZ;
  double marker_size_m = 0.0;
  Transform<devices::EurocBody, Camera> body_from_camera{};
};

/// Writes any of the forms, under a temporary name first; of a COLMAP model the folder is made.
/// Errors: what the writers refuse.
Result<void> WritePath(const CameraPath& path, const std::filesystem::path& file, PathFormat format,
                       const PathWriting& options);

}  // namespace pleinair::exports
