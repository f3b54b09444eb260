#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pleinair::shadows {

/// Axis-aligned box, marker coordinates, metres; empty when min > max.
struct Box {
  glm::dvec3 min{1e300};
  glm::dvec3 max{-1e300};

  bool Empty() const { return min.x > max.x; }
  void Include(const glm::dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void Include(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  bool operator==(const Box&) const = default;
};

/// What a virtual camera sees, for fitting partitions to its view.
struct View {
  /// OpenGL clip coordinates; the picture's row 0 is its top, y is not turned over.
  glm::dmat4 ClipFromMarker() const;

  glm::dmat4 camera_from_marker{1.0};  ///< OpenCV axes: x right, y down, z forward; metres.
  double tan_left = 0.0, tan_right = 0.0, tan_up = 0.0, tan_down = 0.0;  ///< Positive slopes.
  double near_m = 0.1;  ///< Tightened to the nearest visible surface, for the paper's step 1.
  double far_m = 30.0;  ///< Tightened to the farthest visible surface that matters.
};

/// Orthonormal axes of light space in marker coordinates: u and v across the sun's rays, the third
/// towards the sun. Depths count away from the sun.
struct LightAxes {
  glm::dvec3 u, v, to_sun;
  static LightAxes FromSun(const glm::dvec3& to_sun);
};

/// The part of light space that one map covers: a rectangle across the rays, metres, and the depths
/// at which something that is looked up in it can lie.
struct LightWindow {
  glm::dvec2 min{0.0}, max{0.0};
  double receivers_min = -1e300, receivers_max = 1e300;
  bool operator==(const LightWindow&) const = default;
  bool Contains(const LightWindow& other) const {
    return min.x <= other.min.x && min.y <= other.min.y && max.x >= other.max.x &&
           max.y >= other.max.y;
  }
  bool Overlaps(const LightWindow& other) const {
    return min.x < other.max.x && min.y < other.max.y && max.x > other.min.x && max.y > other.min.y;
  }
};

/// Rectangle and depth range of a box seen along the rays.
struct LightExtent {
  LightWindow window;
  double depth_min = 0.0, depth_max = 0.0;

  void Include(const LightAxes& axes, const glm::dvec3& point);
};
LightExtent Project(const LightAxes& axes, const Box& box);

/// Radius, in texels, beyond which no penumbra is followed: an eighth of a map at most, so that its
/// margins leave three quarters of a side to what is seen. Mirrors ShadowWidestKernel in
/// shadow_formulae.glsl.
double WidestKernel(int resolution);

/// Windows around what the view's slices (Eq. 11) can show of `scene`, finest first, each widened
/// by `margin_m` or by the widest kernel, whichever is less (else a scene of kilometres would spend
/// the finest map on its margins). Sides grow in steps of 2^¼ and corners move by whole texels, so
/// that the texels do not crawl while the camera moves. Zhang et al. 2006; snapping after Valient
/// 2008, "Stable rendering of cascaded shadow maps". Deviation: boxes in place of bounding spheres,
/// which are up to three times as large; a turning camera changes the texels' size at the steps
/// alone.
std::vector<LightWindow> FitWindowsToView(const LightAxes& axes, const View& view, int partitions,
                                          double split_weight, std::span<const int> resolutions,
                                          const LightExtent& scene, double margin_m);

/// Windows that do not depend on the camera: the finest covers `focus` and with it everything that
/// `focus` can shade or be shaded by, because shadows move along the rays, which are points of the
/// window; the last covers `scene`; those between grow geometrically. Every window is widened by
/// `margin_m`.
std::vector<LightWindow> FitWindowsToRegion(const LightAxes& axes, const Box& focus,
                                            const Box& scene, int partitions, double margin_m);

}  // namespace pleinair::shadows
