#pragma once

#include "base/frames.h"
#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

// The frames of reference that other programs' files are told in, as types, and the only place
// where they are turned into ours (docs/guide/trajectories.md has the table).

/// A camera as OpenGL, glTF and Blender have it: x right, y up, z backward.
struct GlCamera;
/// glTF's scene: y up, right-handed, metres.
struct YUpScene;

/// Half a turn about x.
inline const Transform<Camera, GlCamera> kCameraFromGlCamera{{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {}};

/// Which axis of a path's reference points up.
enum class UpAxis {
  kZ,       ///< A marker that lies on the ground.
  kY,       ///< A marker on a wall.
  kMinusY,  ///< Many reconstructions: the first camera's axes.
};

/// Turns a reference so that its up is y: about x, so that its x stays.
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
