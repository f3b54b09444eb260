#pragma once

#include <vector>

#include "base/camera_model.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// Where a pinhole camera of the same intrinsics would see what a pixel sees ("undistorted
/// pixels"): the lens's distortion taken out once per camera, at nodes between which it is
/// interpolated. Straight lines of the world are straight in undistorted pixels, so that
/// homographies hold there.
class LensGrid {
 public:
  explicit LensGrid(const CameraModel& camera);

  /// Ideal pixel of a pixel (integer = centre), anywhere in the image or a little outside.
  /// Bilinear between nodes 2 px apart (4 and more from 640×480 on): right to 0.002 px with
  /// ordinary lenses. Not finite where the lens sees nothing.
  Vec2 Undistort(double x, double y) const;

  /// The same for `count` pixels of a row, `step` apart from `x0` on.
  void UndistortRow(double x0, double step, int count, double y, float* undistorted_x,
                    float* undistorted_y) const;

  /// Ideal pixel of a ray (X/Z, Y/Z), and back.
  Vec2 UndistortedOfRay(Vec2 ray) const {
    return {camera_.fx * ray.x + camera_.cx, camera_.fy * ray.y + camera_.cy};
  }
  Vec2 RayOfUndistorted(Vec2 undistorted) const {
    return {(undistorted.x - camera_.cx) / camera_.fx, (undistorted.y - camera_.cy) / camera_.fy};
  }
  /// Pixel that sees what the pinhole camera sees at an undistorted pixel.
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
