#include "app/window/picture_view.h"

#include <algorithm>
#include <cmath>

namespace pleinair::app {

PictureView PictureView::Fit(int width, int height, Vec2 area_corner, Vec2 area_size) {
  PictureView view;
  view.scale = std::max(1e-3, std::min(area_size.x / width, area_size.y / height));
  view.corner = {area_corner.x + (area_size.x - width * view.scale) / 2,
                 area_corner.y + (area_size.y - height * view.scale) / 2};
  return view;
}

Vec2 PictureView::ScreenFromPixel(Vec2 pixel) const {
  // The image corner is at pixel -0.5 (base/pixel_origin.h).
  return {corner.x + (pixel.x + 0.5) * scale, corner.y + (pixel.y + 0.5) * scale};
}

Vec2 PictureView::PixelFromScreen(Vec2 screen) const {
  return {(screen.x - corner.x) / scale - 0.5, (screen.y - corner.y) / scale - 0.5};
}

Sight SightThrough(const CameraModel& camera, const Transform<Camera, Marker>& camera_from_marker,
                   Vec2 pixel) {
  const Vec2 plain = UndistortPixel(camera, pixel);
  const Transform<Marker, Camera> marker_from_camera = camera_from_marker.Inverse();
  return {marker_from_camera.translation_m,
          Normalized(marker_from_camera.rotation * Vec3{plain.x, plain.y, 1.0})};
}

std::optional<Vec3> MeetPlane(const Sight& sight, Vec3 point, Vec3 normal) {
  const double along = Dot(sight.direction, normal);
  const double distance = Dot(point - sight.eye, normal) / along;
  if (!std::isfinite(distance) || distance <= 0.0) return std::nullopt;
  return sight.eye + sight.direction * distance;
}

}  // namespace pleinair::app
