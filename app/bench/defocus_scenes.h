#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "compositor/lens/camera_motion.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/models/placed_model.h"

namespace pleinair::app {

/// A board that faces the camera, in pixels of the pinhole image.
struct BenchBoard {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  double circle_px = 0.0;  ///< compositor::SignedCircle_px(): negative before the focus.
  float light = 0.0F;      ///< Linear, of its own.
  double distance_m = 0.0;

  bool Covers(double x, double y) const { return x >= left && x < right && y >= top && y < bottom; }
};

/// Boards before black, through a lens that focuses at 4 m, or a camera that moves.
struct DefocusScene {
  std::string name;
  std::vector<BenchBoard> boards;  ///< From near to far.
  compositor::ThinLens lens;
  std::vector<compositor::PlacedModel> models;  ///< The same boards.
  Transform<Camera, Marker> camera_from_marker;
  compositor::CameraMotion motion;  ///< While the shutter is open; empty: at rest.
};

/// Names of the scenes:
/// - boards: three that cross, circles of 8, 3.5 and 0 px;
/// - edges: two out of focus whose edges lie within a circle;
/// - fence: bars of 6 px with circles of 12 px before a wall in focus;
/// - stack: eight from 10 px before the focus to 6 px behind;
/// - far: five behind the focus.
std::span<const std::string_view> DefocusSceneNames();

/// Names of scenes whose camera moves. All have the boards of the scene `boards`, at 1.9 to 4 m:
/// - pan: turns by 12 px;
/// - shake: turns by 8 px along a curve, and rolls;
/// - walk: moves sideways, by 12 px on the nearest board and 6 px on the farthest;
/// - dolly: moves forward;
/// - both: walk, through the lens of the scene `boards`.
std::span<const std::string_view> MotionSceneNames();

/// A scene of DefocusSceneNames() or MotionSceneNames() for this camera.
DefocusScene MakeDefocusScene(std::string_view name, const CameraModel& camera);

}  // namespace pleinair::app
