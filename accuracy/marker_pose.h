#pragma once

#include <array>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/units.h"

namespace pleinair::accuracy {

/// Rotation by `angle` (rad) about a unit axis (Rodrigues).
Mat3 RotationAbout(Vec3 axis, double angle);

/// Pose of a marker centred at `centre_px` whose edge would be `side_px` long if frontal, tilted by
/// `tilt` about an axis at the angle `tilt_axis` in its plane, and rotated in its plane by `roll`.
Transform<Camera, Marker> PoseAtPixel(const CameraModel& camera, Vec2 centre_px, double side_px,
                                      Metres size, Radians tilt, Radians tilt_axis, Radians roll);

/// Pixels of the corners of a marker's square: clockwise from top-left on the upright marker.
std::array<Vec2, 4> SquareCorners(const CameraModel& camera,
                                  const Transform<Camera, Marker>& camera_from_marker, Metres size);

/// Homography from undistorted rays (X/Z, Y/Z) to the marker's plane in half edges (x right, y up);
/// up to scale.
Mat3 PlaneFromRays(const Transform<Camera, Marker>& camera_from_marker, Metres size);

/// A rectangle of pixels.
struct PixelBox {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;

  bool Contains(int x, int y) const { return x >= left && x <= right && y >= top && y <= bottom; }
};

/// Bounding box of the square from -`extent` to `extent` half edges, plus 3 px on each side; the
/// whole image if the square reaches behind the camera.
PixelBox BoxOf(const CameraModel& camera, const Transform<Camera, Marker>& camera_from_marker,
               Metres size, double extent);

}  // namespace pleinair::accuracy
