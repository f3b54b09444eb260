#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/error.h"
#include "devices/recordings/euroc.h"
#include "export/trajectories/camera_trajectory.h"
#include "export/trajectories/frames_of_others.h"

namespace pleinair::exports {

/// File formats of a camera trajectory.
enum class TrajectoryFormat {
  kTum,
  kEuroc,
  kColmap,
  kColmapBinary,
  kGltf,
  kMcap,
  kStray,
  kRecord3d
};

/// By name: "tum", "euroc", "colmap", "colmap-binary", "gltf", "mcap", "stray", "record3d"; nothing
/// for others.
std::optional<TrajectoryFormat> TrajectoryFormatNamed(const std::string& name);

/// By file name: .tum and .txt TUM, .csv EuRoC, .glb and .gltf glTF, .mcap MCAP. A .csv with the
/// header of Stray Scanner is such a file; so is a folder with an odometry.csv. A file `metadata`,
/// an .r3d, a .json or a folder with `metadata`, `metadata.json` or one .r3d is Record3D's. Any
/// other folder or name without extension is a COLMAP model, and so is a folder with its cameras.
/// Errors: other names, a folder with several .r3d.
Result<TrajectoryFormat> TrajectoryFormatOf(const std::filesystem::path& file);

/// The format of a file that is to be read: as TrajectoryFormatOf(). Errors: those; nothing of that
/// name; a film; a folder without a trajectory.
Result<TrajectoryFormat> TrajectoryFormatToRead(const std::filesystem::path& file);

struct TrajectoryReading {
  double frame_rate_hz = 0.0;  ///< For COLMAP, which has no times; 0: unknown.
  Transform<devices::EurocBody, Camera> body_from_camera{};
};

/// True for the formats of apps for ARKit: metres, and a frame of reference whose y axis is up.
bool IsArkit(TrajectoryFormat format);

/// Reads TUM, EuRoC, Stray Scanner, Record3D or COLMAP, in the format of the folder's files.
/// Errors: those of the parsers, formats that can only be written.
Result<CameraTrajectory> ReadTrajectory(const std::filesystem::path& file, TrajectoryFormat format,
                                        const TrajectoryReading& options);

struct TrajectoryWriting {
  std::string comment = "camera in its reference";  ///< Header comment of TUM files.
  UpAxis up = UpAxis::kZ;
  double marker_size_m = 0.0;
  Transform<devices::EurocBody, Camera> body_from_camera{};
};

/// Writes any format, under a temporary name first. Creates the folder of a COLMAP model. Errors:
/// those of the writers.
Result<void> WriteTrajectory(const CameraTrajectory& path, const std::filesystem::path& file,
                             TrajectoryFormat format, const TrajectoryWriting& options);

}  // namespace pleinair::exports
