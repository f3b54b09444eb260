#include "compositor/passes/scene_view.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <utility>

#include "shadows/splits.h"

namespace pleinair::compositor {
namespace {

constexpr double kNearM = 0.02;

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

shadows::View ViewOf(const RenderCamera& camera,
                     const Transform<Camera, Marker>& camera_from_marker,
                     const shadows::Box& bounds) {
  const auto [near_m, far_m] = DepthRange(camera_from_marker, bounds);
  shadows::View view;
  view.camera_from_marker = CameraFromMarkerMatrix(camera_from_marker);
  view.near_m = near_m;
  view.far_m = far_m;
  return SeenBy(camera, view);
}

shadows::View SeenBy(const RenderCamera& camera, shadows::View view) {
  view.tan_left = (camera.cx + 0.5) / camera.fx;
  view.tan_right = (camera.width - 0.5 - camera.cx) / camera.fx;
  view.tan_up = (camera.cy + 0.5) / camera.fy;
  view.tan_down = (camera.height - 0.5 - camera.cy) / camera.fy;
  return view;
}

std::array<glm::vec3, 3> RaysThroughPixels(const RenderCamera& camera, const shadows::View& view) {
  const glm::dmat3 marker_from_camera = glm::transpose(glm::dmat3(view.camera_from_marker));
  return {marker_from_camera * glm::dvec3(-view.tan_left, -view.tan_up, 1.0),
          marker_from_camera * glm::dvec3(1.0 / camera.fx, 0.0, 0.0),
          marker_from_camera * glm::dvec3(0.0, 1.0 / camera.fy, 0.0)};
}

SceneProjection ProjectionOf(const RenderCamera& camera, const shadows::View& view, int spread_px) {
  return {camera.width, camera.height, spread_px, glm::mat4(view.ClipFromMarker()),
          static_cast<float>(view.near_m)};
}

FogSplits FogBefore(const shadows::Box& objects, const AerialFog& air, const shadows::View& view,
                    const glm::dvec3& eye_m, const ComposerOptions& options) {
  const glm::dvec3 to_objects = 0.5 * (objects.min + objects.max) - eye_m;
  const double far_off = glm::length(to_objects);
  return air.Along(far_off > 0.0 ? to_objects / far_off : glm::dvec3(0.0, 1.0, 0.0),
                   shadows::PracticalSplits(view.near_m, view.far_m, options.shadow_partitions,
                                            options.shadow_split_weight),
                   options.fog);
}

}  // namespace pleinair::compositor
