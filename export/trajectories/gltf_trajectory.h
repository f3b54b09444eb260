#pragma once

#include <string>

#include "export/trajectories/camera_trajectory.h"
#include "export/trajectories/frames_of_others.h"

namespace pleinair::exports {

struct GltfTrajectoryOptions {
  UpAxis up = UpAxis::kZ;      ///< Of the path's reference.
  double marker_size_m = 0.0;  ///< Shown as a square at the reference's origin; 0: none.
  bool binary = true;          ///< .glb, else .gltf with its data inside.
};

/// A glTF 2.0 scene (Khronos specification, 2.0) with one animated perspective camera: nodes
/// `camera`, `marker` (a square with its print's size, front up) and `points`. Seconds from the
/// path's first pose, linear between poses, y up, metres. A perspective camera holds the field of
/// view alone; where the principal point lies, the distortion and the first pose's time are in the
/// camera's `extras.pleinair`, in our own units (docs/guide/trajectories.md).
/// Errors: the path has no camera, or a fisheye lens, whose picture no perspective camera has.
Result<std::string> GltfFromTrajectory(const CameraTrajectory& path,
                                       const GltfTrajectoryOptions& options);

}  // namespace pleinair::exports
