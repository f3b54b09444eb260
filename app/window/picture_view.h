#pragma once

#include <optional>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::app {

/// Placement of a camera image on the screen: centred, as large as possible, with its aspect ratio.
struct PictureView {
  Vec2 corner;         ///< Upper left, screen coordinates.
  double scale = 1.0;  ///< Screen units per image pixel.

  static PictureView Fit(int width, int height, Vec2 area_corner, Vec2 area_size);

  Vec2 ScreenFromPixel(Vec2 pixel) const;
  Vec2 PixelFromScreen(Vec2 screen) const;
};

/// A viewing ray in marker coordinates.
struct Sight {
  Vec3 eye;
  Vec3 direction;  ///< Unit.
};
Sight SightThrough(const CameraModel& camera, const Transform<Camera, Marker>& camera_from_marker,
                   Vec2 pixel);

/// Intersects a viewing ray with the plane through `point` with that normal; nothing if the ray
/// leads away from it.
std::optional<Vec3> MeetPlane(const Sight& sight, Vec3 point, Vec3 normal);

}  // namespace pleinair::app
