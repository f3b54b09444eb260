#pragma once

#include <string>

#include "export/trajectories/camera_trajectory.h"
#include "export/trajectories/frames_of_others.h"

namespace pleinair::exports {

struct GltfTrajectoryOptions {
  UpAxis up = UpAxis::kZ;      ///< Up axis of the trajectory's reference.
  double marker_size_m = 0.0;  ///< Drawn as a square at the reference's origin; 0: none.
  bool binary = true;          ///< .glb, else .gltf with embedded data.
};

/// Writes a glTF 2.0 scene (Khronos specification, 2.0) with one animated perspective camera. Its
/// nodes are `camera`, `marker` (a square of the marker's size, front up) and `points`. Times are
/// seconds from the first pose, with linear interpolation; y up, metres.
/// A perspective camera stores only the field of view. Principal point, distortion and the first
/// pose's time are in the camera's `extras.pleinair`, in our own units
/// (docs/guide/trajectories.md).
/// Errors: the trajectory has no camera, or a fisheye lens, which is not a perspective camera.
Result<std::string> GltfFromTrajectory(const CameraTrajectory& path,
                                       const GltfTrajectoryOptions& options);

}  // namespace pleinair::exports
