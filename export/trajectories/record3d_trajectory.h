#pragma once

#include <string>
#include <string_view>

#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// Parses the metadata of Record3D, an app for ARKit: the JSON file `metadata` in an .r3d archive,
/// or `metadata.json` of an export. Source: the readers of github.com/nerfstudio-project/nerfstudio
/// (process_data/record3d_utils.py) and of github.com/codekansas/usa (tasks/datasets/r3d.py).
/// `poses` has one entry [qx, qy, qz, qw, tx, ty, tz] a frame: world from camera, metres.
/// The world is ARKit's: y up. The camera has x right, y up, z backward in the archive's images.
/// `frameTimestamps` has the frames' times in seconds; without it they follow from `fps`.
/// `K` is the lens, column by column, for images of `w` × `h` pixels, with the pixel origin at the
/// corner. Errors: not JSON, no poses, malformed or non-finite numbers, quaternions that are not
/// rotations. Also times that do not ascend, or of another number than poses.
Result<CameraTrajectory> ParseRecord3dMetadata(std::string_view text, const std::string& name);

}  // namespace pleinair::exports
