#pragma once

#include <memory>
#include <vector>

#include "tests/tracker/marker_rendering.h"
#include "tracker/calibration/calibration_board.h"

namespace pleinair::tracker {

/// A chessboard or ChArUco board as a print; its `edge_modules` are one square, and its middle is
/// the board's. `legacy`: laid out as before OpenCV 4.6.
std::shared_ptr<const MarkerPattern> BoardPattern(const CalibrationBoard& board,
                                                  bool legacy = false);

/// A picture of the board.
GreyImage RenderBoard(const CameraModel& camera, const CalibrationBoard& board,
                      const Transform<Camera, Marker>& camera_from_board,
                      const RenderingOptions& options, bool legacy = false);

/// The board in twelve places all over the picture, near and far, tilted by up to `tilt_deg` in all
/// directions; its `width_m` then is about a third to two thirds of the picture.
std::vector<Transform<Camera, Marker>> BoardPoses(const CameraModel& camera, double width_m,
                                                  double tilt_deg);

}  // namespace pleinair::tracker
