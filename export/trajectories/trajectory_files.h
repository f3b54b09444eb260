#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/error.h"
#include "devices/recordings/euroc.h"
#include "export/trajectories/camera_trajectory.h"
#include "export/trajectories/frames_of_others.h"

namespace pleinair::exports {

/// Forms that a camera's path has in files.
enum class TrajectoryFormat { kTum, kEuroc, kColmap, kColmapBinary, kGltf, kMcap };

/// By name: "tum", "euroc", "colmap", "colmap-binary", "gltf", "mcap"; nothing for others.
std::optional<TrajectoryFormat> TrajectoryFormatNamed(const std::string& name);

/// By a file's name: .tum and .txt TUM, .csv EuRoC, .glb and .gltf glTF, .mcap MCAP; a folder or a
/// name without extension is a COLMAP model. Errors: other names.
Result<TrajectoryFormat> TrajectoryFormatOf(const std::filesystem::path& file);

struct TrajectoryReading {
  double frame_rate_hz = 0.0;  ///< For COLMAP, which knows no times; 0: nobody said.
  Transform<devices::EurocBody, Camera> body_from_camera{};
};

/// Reads TUM, EuRoC or COLMAP, this in the form that the folder has. Errors: what their parsers
/// refuse, forms that are only written.
Result<CameraTrajectory> ReadTrajectory(const std::filesystem::path& file, TrajectoryFormat format,
                                        const TrajectoryReading& options);

struct TrajectoryWriting {
  std::string comment = "camera in its reference";  ///< What TUM lines are headed with.
  UpAxis up = UpAxis::kZ;
  double marker_size_m = 0.0;
  Transform<devices::EurocBody, Camera> body_from_camera{};
};

/// Writes any of the forms, under a temporary name first; of a COLMAP model the folder is made.
/// Errors: what the writers refuse.
Result<void> WriteTrajectory(const CameraTrajectory& path, const std::filesystem::path& file,
                             TrajectoryFormat format, const TrajectoryWriting& options);

}  // namespace pleinair::exports
