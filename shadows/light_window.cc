#include "shadows/light_window.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shadows/splits.h"

namespace pleinair::shadows {
namespace {

LightWindow Widened(LightWindow window, double margin) {
  window.min -= margin;
  window.max += margin;
  return window;
}

struct Sphere {
  glm::dvec3 center;
  double radius;
};

// Sphere around the slice of the view between two depths, marker coordinates. Its size depends on
// the intrinsics and depths alone, so the window keeps its size while the camera turns.
Sphere SliceSphere(const View& view, double near_m, double far_m) {
  const glm::dmat4 marker_from_camera = glm::inverse(view.camera_from_marker);
  std::array<glm::dvec3, 8> corners;
  std::size_t count = 0;
  for (const double depth : {near_m, far_m}) {
    for (const double x : {-view.tan_left, view.tan_right}) {
      for (const double y : {-view.tan_up, view.tan_down}) {
        corners[count++] = glm::dvec3(x * depth, y * depth, depth);
      }
    }
  }
  glm::dvec3 center(0.0);
  for (const glm::dvec3& corner : corners) center += corner / 8.0;
  double radius = 0.0;
  for (const glm::dvec3& corner : corners) radius = std::max(radius, glm::distance(center, corner));
  return {glm::dvec3(marker_from_camera * glm::dvec4(center, 1.0)), radius};
}

}  // namespace

LightAxes LightAxes::FromSun(const glm::dvec3& to_sun) {
  const glm::dvec3 w = glm::normalize(to_sun);
  // The marker's z as "up" keeps u level on a marker that lies on the ground.
  const glm::dvec3 up = std::abs(w.z) < 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(up, w));
  return {u, glm::cross(w, u), w};
}

LightExtent Project(const LightAxes& axes, const Box& box) {
  LightExtent extent{{glm::dvec2(1e300), glm::dvec2(-1e300)}, 1e300, -1e300};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) != 0 ? box.max.x : box.min.x,
                       (corner & 2) != 0 ? box.max.y : box.min.y,
                       (corner & 4) != 0 ? box.max.z : box.min.z);
    const glm::dvec2 across(glm::dot(p, axes.u), glm::dot(p, axes.v));
    const double depth = -glm::dot(p, axes.to_sun);
    extent.window.min = glm::min(extent.window.min, across);
    extent.window.max = glm::max(extent.window.max, across);
    extent.depth_min = std::min(extent.depth_min, depth);
    extent.depth_max = std::max(extent.depth_max, depth);
  }
  return extent;
}

std::vector<LightWindow> FitWindowsToView(const LightAxes& axes, const View& view, int partitions,
                                          double split_weight, std::span<const int> resolutions) {
  const std::vector<double> splits =
      PracticalSplits(view.near_m, view.far_m, partitions, split_weight);
  std::vector<LightWindow> windows;
  for (int i = 0; i < partitions; ++i) {
    const Sphere sphere = SliceSphere(view, splits[i], splits[i + 1]);
    // One texel of slack at each side for the snapping; kernels that reach outside the window see
    // the clamped edge, which the sphere's slack around the frustum keeps out of the picture.
    const double texel = 2.0 * sphere.radius / (resolutions[i] - 2);
    const glm::dvec2 corner =
        glm::dvec2(glm::dot(sphere.center, axes.u), glm::dot(sphere.center, axes.v)) -
        sphere.radius;
    const glm::dvec2 snapped = glm::floor(corner / texel) * texel;
    windows.push_back({snapped, snapped + texel * resolutions[i]});
  }
  return windows;
}

std::vector<LightWindow> FitWindowsToRegion(const LightAxes& axes, const Box& focus,
                                            const Box& scene, int partitions, double margin_m) {
  LightWindow whole = Project(axes, scene).window;
  const LightWindow finest = Widened(Project(axes, focus.Empty() ? scene : focus).window, margin_m);
  whole.min = glm::min(whole.min, finest.min);
  whole.max = glm::max(whole.max, finest.max);
  whole = Widened(whole, margin_m);
  std::vector<LightWindow> windows{finest};
  for (int i = 1; i < partitions; ++i) {
    // Each side moves from the finest towards the whole so that areas grow evenly.
    const double share = static_cast<double>(i) / (partitions - 1);
    const glm::dvec2 fine_size = finest.max - finest.min;
    const glm::dvec2 whole_size = whole.max - whole.min;
    const glm::dvec2 size = fine_size * glm::pow(whole_size / fine_size, glm::dvec2(share));
    const glm::dvec2 grown = glm::dvec2(
        whole_size.x > fine_size.x ? (size.x - fine_size.x) / (whole_size.x - fine_size.x) : 1.0,
        whole_size.y > fine_size.y ? (size.y - fine_size.y) / (whole_size.y - fine_size.y) : 1.0);
    windows.push_back(
        {glm::mix(finest.min, whole.min, grown), glm::mix(finest.max, whole.max, grown)});
  }
  if (partitions == 1) windows.front() = whole;
  return windows;
}

}  // namespace pleinair::shadows
