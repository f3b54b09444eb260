#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/models/placed_model.h"

namespace pleinair::app {

/// A board that faces the camera, in pixels of the pinhole image.
struct BenchBoard {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  double circle_px = 0.0;  ///< compositor::SignedCircle_px(): negative before the focus.
  float light = 0.0F;      ///< Linear, of its own.

  bool Covers(double x, double y) const { return x >= left && x < right && y >= top && y < bottom; }
};

/// Boards before black, through a lens that focuses at 4 m.
struct DefocusScene {
  std::string name;
  std::vector<BenchBoard> boards;  ///< From near to far.
  compositor::ThinLens lens;
  std::vector<compositor::PlacedModel> models;  ///< The same boards.
  Transform<Camera, Marker> camera_from_marker;
};

/// Names of the scenes:
/// - boards: three that cross, circles of 8, 3.5 and 0 px;
/// - edges: two out of focus whose edges lie within a circle;
/// - fence: bars of 6 px with circles of 12 px before a wall in focus;
/// - stack: eight from 10 px before the focus to 6 px behind;
/// - far: five behind the focus.
std::span<const std::string_view> DefocusSceneNames();

/// A scene of DefocusSceneNames() for this camera.
DefocusScene MakeDefocusScene(std::string_view name, const CameraModel& camera);

}  // namespace pleinair::app
