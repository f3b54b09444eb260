#pragma once

#include "base/camera_model.h"
#include "base/image_size.h"

namespace pleinair {

/// Camera model for images resized to `size`.
inline CameraModel ScaleCamera(const CameraModel& camera, ImageSize size) {
  CameraModel scaled = camera;
  const double sx = static_cast<double>(size.width) / camera.width;
  const double sy = static_cast<double>(size.height) / camera.height;
  scaled.width = size.width;
  scaled.height = size.height;
  scaled.fx = camera.fx * sx;
  scaled.fy = camera.fy * sy;
  // Resizing keeps the outer corner of the first pixel, at (−0.5, −0.5), in place.
  scaled.cx = (camera.cx + 0.5) * sx - 0.5;
  scaled.cy = (camera.cy + 0.5) * sy - 0.5;
  return scaled;
}

}  // namespace pleinair
