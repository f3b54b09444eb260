#pragma once

#include "base/frames.h"
#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

// Frames of reference of other programs' files, as types. Only this file converts them to ours
// (table: docs/guide/trajectories.md).

/// The camera frame of OpenGL, glTF and Blender: x right, y up, z backward.
struct GlCamera;
/// glTF's scene: y up, right-handed, metres.
struct YUpScene;

/// Half a turn about x.
inline const Transform<Camera, GlCamera> kCameraFromGlCamera{{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {}};

/// The upward axis of a trajectory's frame of reference.
enum class UpAxis {
  kZ,       ///< A marker lying on the ground.
  kY,       ///< A marker on a wall.
  kMinusY,  ///< Many reconstructions: the first camera's axes.
};

/// Rotates a frame of reference about x, so that y points up.
inline Transform<YUpScene, Reference> SceneFromReference(UpAxis up) {
  switch (up) {
    case UpAxis::kZ:
      return {{{1, 0, 0, 0, 0, 1, 0, -1, 0}}, {}};
    case UpAxis::kY:
      break;
    case UpAxis::kMinusY:
      return {{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {}};
  }
  return {};
}

}  // namespace pleinair::exports
