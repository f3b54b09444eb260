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

// Light-space extent of the view frustum between two depths: the box of its eight corners.
LightExtent SliceExtent(const LightAxes& axes, const View& view, double near_m, double far_m) {
  const glm::dmat4 marker_from_camera = glm::inverse(view.camera_from_marker);
  LightExtent extent{{glm::dvec2(1e300), glm::dvec2(-1e300)}, 1e300, -1e300};
  for (const double depth : {near_m, far_m}) {
    for (const double x : {-view.tan_left, view.tan_right}) {
      for (const double y : {-view.tan_up, view.tan_down}) {
        extent.Include(
            axes, glm::dvec3(marker_from_camera * glm::dvec4(x * depth, y * depth, depth, 1.0)));
      }
    }
  }
  return extent;
}

// The smallest power of 2^¼ that is at least `length`.
double SteppedSide(double length) {
  return std::exp2(std::ceil(4.0 * std::log2(std::max(length, 1e-6))) / 4.0);
}

// Margin, metres, as wide as the maximum kernel around `shown` metres in a map of that size. A
// slice outside the scene contains one point of it.
double UsefulMargin(double shown, int resolution) {
  constexpr double kMinShown_m = 0.05;
  const double texels = WidestKernel(resolution);
  return std::max(shown, kMinShown_m) * texels / (resolution - 2 - 2.0 * texels);
}

}  // namespace

double WidestKernel(int resolution) { return std::min(128.0, resolution / 8.0); }

LightAxes LightAxes::FromSun(const glm::dvec3& to_sun) {
  const glm::dvec3 w = glm::normalize(to_sun);
  // With the marker's z as "up", u stays level for a marker that lies on the ground.
  const glm::dvec3 up = std::abs(w.z) < 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(up, w));
  return {u, glm::cross(w, u), w};
}

void LightExtent::Include(const LightAxes& axes, const glm::dvec3& p) {
  const glm::dvec2 across(glm::dot(p, axes.u), glm::dot(p, axes.v));
  const double depth = -glm::dot(p, axes.to_sun);
  window.min = glm::min(window.min, across);
  window.max = glm::max(window.max, across);
  depth_min = std::min(depth_min, depth);
  depth_max = std::max(depth_max, depth);
}

glm::dmat4 View::ClipFromMarker() const {
  glm::dmat4 clip_from_camera(0.0);
  clip_from_camera[0][0] = 2.0 / (tan_left + tan_right);
  clip_from_camera[1][1] = 2.0 / (tan_up + tan_down);
  clip_from_camera[2][0] = (tan_left - tan_right) / (tan_left + tan_right);
  clip_from_camera[2][1] = (tan_up - tan_down) / (tan_up + tan_down);
  clip_from_camera[2][2] = (far_m + near_m) / (far_m - near_m);
  clip_from_camera[2][3] = 1.0;
  clip_from_camera[3][2] = -2.0 * far_m * near_m / (far_m - near_m);
  return clip_from_camera * camera_from_marker;
}

LightExtent Project(const LightAxes& axes, const Box& box) {
  LightExtent extent{{glm::dvec2(1e300), glm::dvec2(-1e300)}, 1e300, -1e300};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) != 0 ? box.max.x : box.min.x,
                       (corner & 2) != 0 ? box.max.y : box.min.y,
                       (corner & 4) != 0 ? box.max.z : box.min.z);
    extent.Include(axes, p);
  }
  return extent;
}

std::vector<LightWindow> FitWindowsToView(const LightAxes& axes, const View& view, int partitions,
                                          double split_weight, std::span<const int> resolutions,
                                          const LightExtent& scene, double margin_m) {
  const std::vector<double> splits =
      PracticalSplits(view.near_m, view.far_m, partitions, split_weight);
  std::vector<LightWindow> windows;
  for (int i = 0; i < partitions; ++i) {
    const LightExtent seen = SliceExtent(axes, view, splits[i], splits[i + 1]);
    // The part of the view that the scene can fill; a slice outside the scene keeps one point of
    // it.
    const glm::dvec2 low = glm::clamp(seen.window.min, scene.window.min, scene.window.max);
    const glm::dvec2 high = glm::clamp(seen.window.max, scene.window.min, scene.window.max);
    LightWindow window;
    for (int axis = 0; axis < 2; ++axis) {
      const double shown = high[axis] - low[axis];
      const double side =
          SteppedSide(shown + 2.0 * std::min(margin_m, UsefulMargin(shown, resolutions[i])));
      // One texel of slack at each side for the snapping.
      const double texel = side / (resolutions[i] - 2);
      const double corner = 0.5 * (low[axis] + high[axis] - side);
      window.min[axis] = std::floor(corner / texel) * texel;
      window.max[axis] = window.min[axis] + texel * resolutions[i];
    }
    // Depths move in steps too: a map whose window is unchanged need not be redrawn.
    const double step = SteppedSide(seen.depth_max - seen.depth_min) / 16.0;
    window.receivers_min = std::floor(seen.depth_min / step) * step;
    window.receivers_max = std::ceil(seen.depth_max / step) * step;
    windows.push_back(window);
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
    // Each side is interpolated from the finest to the whole so that areas grow evenly.
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
