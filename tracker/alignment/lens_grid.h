#pragma once

#include <vector>

#include "base/camera_model.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// Maps pixels to undistorted pixels, the pixels of a pinhole camera with the same intrinsics. The
/// inverse distortion is computed once per camera at grid nodes and interpolated. In undistorted
/// pixels, straight lines of the scene are straight and planes map by homographies.
class LensGrid {
 public:
  explicit LensGrid(const CameraModel& camera);

  /// Undistorted pixel of a pixel (integer = centre), inside the image or slightly outside.
  /// Bilinear interpolation between nodes 2 px apart (4 px and more from 640×480 on); accurate to
  /// 0.002 px with ordinary lenses. Not finite outside the lens's field of view.
  Vec2 Undistort(double x, double y) const;

  /// As Undistort(), for `count` pixels of a row, `step` apart from `x0` on.
  void UndistortRow(double x0, double step, int count, double y, float* undistorted_x,
                    float* undistorted_y) const;

  /// Undistorted pixel of a ray (X/Z, Y/Z), and the inverse.
  Vec2 UndistortedOfRay(Vec2 ray) const {
    return {camera_.fx * ray.x + camera_.cx, camera_.fy * ray.y + camera_.cy};
  }
  Vec2 RayOfUndistorted(Vec2 undistorted) const {
    return {(undistorted.x - camera_.cx) / camera_.fx, (undistorted.y - camera_.cy) / camera_.fy};
  }
  /// Distorted pixel of an undistorted pixel.
  Vec2 PixelOfUndistorted(Vec2 undistorted) const;

  const CameraModel& camera() const { return camera_; }

 private:
  CameraModel camera_;
  bool bends_ = false;
  int spacing_ = 2;
  int columns_ = 0, rows_ = 0;
  std::vector<Vec2> nodes_;
};

}  // namespace pleinair::tracker
