#include "compositor/passes/scene_view.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <utility>

namespace pleinair::compositor {
namespace {

constexpr double kNearM = 0.02;

glm::dmat4 CameraFromMarkerMatrix(const Transform<Camera, Marker>& camera_from_marker) {
  glm::dmat4 matrix(1.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      matrix[column][row] = camera_from_marker.rotation(row, column);
    }
  }
  const Vec3 t = camera_from_marker.translation_m;
  matrix[3] = glm::dvec4(t.x, t.y, t.z, 1.0);
  return matrix;
}

glm::dvec3 Corner(const shadows::Box& box, int corner) {
  return {(corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
          (corner & 4) != 0 ? box.max.z : box.min.z};
}

/// Minimum and maximum depth of the scene.
std::pair<double, double> DepthRange(const Transform<Camera, Marker>& camera_from_marker,
                                     const shadows::Box& bounds) {
  double nearest = 1e30, farthest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at = Corner(bounds, corner);
    const Point<Marker> point{{at.x, at.y, at.z}};
    const double depth = (camera_from_marker * point).xyz.z;
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const double near_m = std::max(nearest * 0.99, kNearM);
  return {near_m, std::max(farthest * 1.01, 2 * near_m)};
}

}  // namespace

shadows::View ViewOf(const RenderCamera& camera,
                     const Transform<Camera, Marker>& camera_from_marker,
                     const shadows::Box& bounds) {
  const auto [near_m, far_m] = DepthRange(camera_from_marker, bounds);
  shadows::View view;
  view.camera_from_marker = CameraFromMarkerMatrix(camera_from_marker);
  view.tan_left = (camera.cx + 0.5) / camera.fx;
  view.tan_right = (camera.width - 0.5 - camera.cx) / camera.fx;
  view.tan_up = (camera.cy + 0.5) / camera.fy;
  view.tan_down = (camera.height - 0.5 - camera.cy) / camera.fy;
  view.near_m = near_m;
  view.far_m = far_m;
  return view;
}

std::array<glm::vec3, 3> RaysThroughPixels(const RenderCamera& camera, const shadows::View& view) {
  const glm::dmat3 marker_from_camera = glm::transpose(glm::dmat3(view.camera_from_marker));
  return {marker_from_camera * glm::dvec3(-view.tan_left, -view.tan_up, 1.0),
          marker_from_camera * glm::dvec3(1.0 / camera.fx, 0.0, 0.0),
          marker_from_camera * glm::dvec3(0.0, 1.0 / camera.fy, 0.0)};
}

PixelRect PictureOf(const RenderCamera& camera, const shadows::View& view,
                    const shadows::Box& bounds) {
  if (bounds.Empty()) return {};
  const PixelRect whole{0, 0, camera.width, camera.height};
  const glm::dmat4 clip_from_marker = view.ClipFromMarker();
  glm::dvec2 low(1e30), high(-1e30);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 clip = clip_from_marker * glm::dvec4(Corner(bounds, corner), 1.0);
    if (clip.w < kNearM) return whole;
    const glm::dvec2 at =
        (0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(camera.width, camera.height);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  // Samples lie anywhere in a pixel; one more for rounding.
  const glm::dvec2 size(camera.width, camera.height);
  low = glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0.0), size);
  high = glm::clamp(glm::ceil(high) + 1.0, glm::dvec2(0.0), size);
  return {static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x - low.x),
          static_cast<int>(high.y - low.y)};
}

}  // namespace pleinair::compositor
