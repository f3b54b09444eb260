#include "accuracy/marker_pose.h"

#include <algorithm>
#include <cmath>

#include "tracker/pose/homography.h"

namespace pleinair::accuracy {

Mat3 RotationAbout(Vec3 axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), t = 1.0 - c;
  const auto [x, y, z] = axis;
  return {{t * x * x + c, t * x * y - s * z, t * x * z + s * y, t * x * y + s * z, t * y * y + c,
           t * y * z - s * x, t * x * z - s * y, t * y * z + s * x, t * z * z + c}};
}

Transform<Camera, Marker> PoseAtPixel(const CameraModel& camera, Vec2 centre_px, double side_px,
                                      Metres size, Radians tilt, Radians tilt_axis, Radians roll) {
  const Vec2 ray = UndistortPixel(camera, centre_px);
  const Vec3 direction = Normalized(Vec3{ray.x, ray.y, 1.0});
  // The smallest rotation that takes the optical axis to the line of sight.
  const Vec3 cross = Cross({0, 0, 1}, direction);
  const double sine = Norm(cross);
  const Mat3 facing =
      sine > 1e-12 ? RotationAbout(cross * (1.0 / sine), std::atan2(sine, direction.z)) : Mat3{};
  // The marker's y is up and its z points to the viewer: half a turn about x from the camera's
  // axes.
  constexpr Mat3 kUpright{{1, 0, 0, 0, -1, 0, 0, 0, -1}};
  const Mat3 tilted =
      RotationAbout({std::cos(tilt_axis.value()), std::sin(tilt_axis.value()), 0.0}, tilt.value());
  return {facing * tilted * RotationAbout({0, 0, 1}, roll.value()) * kUpright,
          direction * (camera.fx * size.value() / side_px)};
}

std::array<Vec2, 4> SquareCorners(const CameraModel& camera,
                                  const Transform<Camera, Marker>& camera_from_marker,
                                  Metres size) {
  std::array<Vec2, 4> corners;
  for (int i = 0; i < 4; ++i) {
    const Vec2 corner = tracker::kSquareCorners[i] * (0.5 * size.value());
    corners[i] =
        ProjectToPixel(camera, camera_from_marker * Point<Marker>{{corner.x, corner.y, 0.0}});
  }
  return corners;
}

Mat3 PlaneFromRays(const Transform<Camera, Marker>& camera_from_marker, Metres size) {
  const double half = 0.5 * size.value();
  const Vec3& t = camera_from_marker.translation_m;
  Mat3 rays_from_plane = camera_from_marker.rotation;
  for (int row = 0; row < 3; ++row) {
    rays_from_plane(row, 0) *= half;
    rays_from_plane(row, 1) *= half;
    rays_from_plane(row, 2) = row == 0 ? t.x : row == 1 ? t.y : t.z;
  }
  return tracker::Adjugate(rays_from_plane);
}

PixelBox BoxOf(const CameraModel& camera, const Transform<Camera, Marker>& camera_from_marker,
               Metres size, double extent) {
  constexpr int kSteps = 16;          // Along a side, since lenses bend sides.
  constexpr double kMargin_px = 3.0;  // A pixel's own width, and the bend between two steps.
  constexpr double kAll = 1e9;
  const double half = 0.5 * size.value() * extent;
  PixelBox box;
  for (int side = 0; side < 4; ++side) {
    for (int step = 0; step < kSteps; ++step) {
      const double along = step / static_cast<double>(kSteps);
      const Vec2 from = tracker::kSquareCorners[side], to = tracker::kSquareCorners[(side + 1) % 4];
      const Vec2 at = (from * (1.0 - along) + to * along) * half;
      const Point<Camera> point = camera_from_marker * Point<Marker>{{at.x, at.y, 0.0}};
      // Partly behind the camera: it may appear anywhere.
      if (point.xyz.z < 1e-6) return {-kAll, kAll, -kAll, kAll};
      const Vec2 pixel = ProjectToPixel(camera, point);
      box = {std::min(box.left, pixel.x - kMargin_px), std::max(box.right, pixel.x + kMargin_px),
             std::min(box.top, pixel.y - kMargin_px), std::max(box.bottom, pixel.y + kMargin_px)};
    }
  }
  return box;
}

}  // namespace pleinair::accuracy
