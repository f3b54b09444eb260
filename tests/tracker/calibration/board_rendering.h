#pragma once

#include <memory>
#include <vector>

#include "tests/tracker/marker_rendering.h"
#include "tracker/calibration/calibration_board.h"

namespace pleinair::tracker {

/// A camera of 640×480 pixels with the distortion of an ordinary lens.
CameraModel BoardCamera();

/// A chessboard or ChArUco board as a marker pattern. Its `edge_modules` are one square; its centre
/// is the board's. `legacy`: the layout of OpenCV versions before 4.6.
std::shared_ptr<const MarkerPattern> BoardPattern(const CalibrationBoard& board,
                                                  bool legacy = false);

/// An image of the board.
GreyImage RenderBoard(const CameraModel& camera, const CalibrationBoard& board,
                      const Transform<Camera, Marker>& camera_from_board,
                      const RenderingOptions& options, bool legacy = false);

/// Twelve poses of the board all over the image, near and far, tilted by up to `tilt_deg` in all
/// directions. Its `width_m` covers about a third to two thirds of the image.
std::vector<Transform<Camera, Marker>> BoardPoses(const CameraModel& camera, double width_m,
                                                  double tilt_deg);

}  // namespace pleinair::tracker
