#pragma once

#include <array>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/units.h"

namespace pleinair::accuracy {

/// Turn by `angle` (rad) about a unit axis (Rodrigues).
Mat3 RotationAbout(Vec3 axis, double angle);

/// The pose of a print seen at `centre_px` with its edge `side_px` long were it frontal, tilted by
/// `tilt` about an axis at `tilt_axis` in its plane and turned in its plane by `roll`.
Transform<Camera, Marker> PoseAtPixel(const CameraModel& camera, Vec2 centre_px, double side_px,
                                      Metres size, Radians tilt, Radians tilt_axis, Radians roll);

/// Where the corners of a marker's square lie: top-left, then clockwise as the print is read.
std::array<Vec2, 4> SquareCorners(const CameraModel& camera,
                                  const Transform<Camera, Marker>& camera_from_marker, Metres size);

/// Takes undistorted rays (X/Z, Y/Z) to the marker's plane in half edges (x right, y up); up to
/// scale.
Mat3 PlaneFromRays(const Transform<Camera, Marker>& camera_from_marker, Metres size);

/// Pixels that may see a square of the marker's plane.
struct PixelBox {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;

  bool Contains(int x, int y) const { return x >= left && x <= right && y >= top && y <= bottom; }
};

/// The box of the square from -`extent` to `extent` half edges, with 3 px around it; all of the
/// picture where the square reaches behind the camera.
PixelBox BoxOf(const CameraModel& camera, const Transform<Camera, Marker>& camera_from_marker,
               Metres size, double extent);

}  // namespace pleinair::accuracy
