#pragma once

#include <optional>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::app {

/// Where a camera's picture lies on the screen: as large as fits, in the middle, its proportions
/// kept.
struct PictureView {
  Vec2 corner;         ///< Upper left, screen coordinates.
  double scale = 1.0;  ///< Screen units a pixel of the picture.

  static PictureView Fit(int width, int height, Vec2 area_corner, Vec2 area_size);

  Vec2 ScreenFromPixel(Vec2 pixel) const;
  Vec2 PixelFromScreen(Vec2 screen) const;
};

/// A line of sight in marker coordinates.
struct Sight {
  Vec3 eye;
  Vec3 direction;  ///< Unit.
};
Sight SightThrough(const CameraModel& camera, const Transform<Camera, Marker>& camera_from_marker,
                   Vec2 pixel);

/// Where a line of sight meets the plane through `point` with that normal; nothing where it leads
/// away from it.
std::optional<Vec3> MeetPlane(const Sight& sight, Vec3 point, Vec3 normal);

}  // namespace pleinair::app
