#pragma once

// A phone's lens, and turns from which tests make its way.

#include <cmath>

#include "base/camera_model.h"
#include "base/vector.h"

namespace pleinair::session {

inline CameraModel PhoneLens() {
  CameraModel camera;
  camera.width = 1920;
  camera.height = 1080;
  camera.fx = camera.fy = 1500.0;
  camera.cx = 959.5;
  camera.cy = 539.5;
  camera.distortion[0] = 0.05;
  return camera;
}

/// Right-handed rotation about the x (0), y (1) or z axis (2) by an angle in radians.
inline Mat3 About(int axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  if (axis == 0) return Mat3{{1, 0, 0, 0, c, -s, 0, s, c}};
  if (axis == 1) return Mat3{{c, 0, s, 0, 1, 0, -s, 0, c}};
  return Mat3{{c, -s, 0, s, c, 0, 0, 0, 1}};
}

}  // namespace pleinair::session
