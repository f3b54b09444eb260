#pragma once

#include <vector>

#include "base/camera_model.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// Where a pinhole camera of the same intrinsics would see what a pixel sees ("ideal pixels"): the
/// lens's distortion taken out once per camera, at nodes between which it is interpolated.
/// Straight lines of the world are straight in ideal pixels, so that homographies hold there.
class LensGrid {
 public:
  explicit LensGrid(const CameraModel& camera);

  /// Ideal pixel of a pixel (integer = centre), anywhere in the picture or a little outside.
  /// Bilinear between nodes 2 px apart (4 and more from 640×480 on): right to 0.002 px with
  /// ordinary lenses. Not finite where the lens sees nothing.
  Vec2 Ideal(double x, double y) const;

  /// The same for `count` pixels of a row, `step` apart from `x0` on.
  void IdealRow(double x0, double step, int count, double y, float* ideal_x, float* ideal_y) const;

  /// Ideal pixel of a ray (X/Z, Y/Z), and back.
  Vec2 IdealOfRay(Vec2 ray) const {
    return {camera_.fx * ray.x + camera_.cx, camera_.fy * ray.y + camera_.cy};
  }
  Vec2 RayOfIdeal(Vec2 ideal) const {
    return {(ideal.x - camera_.cx) / camera_.fx, (ideal.y - camera_.cy) / camera_.fy};
  }
  /// Pixel that sees what the pinhole camera sees at an ideal pixel.
  Vec2 PixelOfIdeal(Vec2 ideal) const;

  const CameraModel& camera() const { return camera_; }

 private:
  CameraModel camera_;
  bool bends_ = false;
  int spacing_ = 2;
  int columns_ = 0, rows_ = 0;
  std::vector<Vec2> nodes_;
};

}  // namespace pleinair::tracker
