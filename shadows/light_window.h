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

/// A virtual camera, to which partitions are fitted.
struct View {
  /// OpenGL clip coordinates. Row 0 of the image is at the top; y is not flipped.
  glm::dmat4 ClipFromMarker() const;

  glm::dmat4 camera_from_marker{1.0};  ///< OpenCV axes: x right, y down, z forward; metres.
  double tan_left = 0.0, tan_right = 0.0, tan_up = 0.0, tan_down = 0.0;  ///< Positive slopes.
  double near_m = 0.1;  ///< Tightened to the nearest visible surface, for the paper's step 1.
  double far_m = 30.0;  ///< Tightened to the farthest relevant visible surface.
};

/// Orthonormal axes of light space in marker coordinates: u and v perpendicular to the sun's rays,
/// the third towards the sun. Depths increase away from the sun.
struct LightAxes {
  glm::dvec3 u, v, to_sun;
  static LightAxes FromSun(const glm::dvec3& to_sun);
};

/// The part of light space covered by one map: a rectangle perpendicular to the rays, metres, and
/// the depth range of the receivers in it.
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

/// Rectangle and depth range of a box in light space.
struct LightExtent {
  LightWindow window;
  double depth_min = 0.0, depth_max = 0.0;

  void Include(const LightAxes& axes, const glm::dvec3& point);
};
LightExtent Project(const LightAxes& axes, const Box& box);

/// Maximum radius of a penumbra kernel, in texels: an eighth of a map, so that the margins leave
/// three quarters of a side to visible surfaces. Mirrors ShadowWidestKernel in
/// shadow_formulae.glsl.
double WidestKernel(int resolution);

/// Windows around the parts of `scene` in the view's slices (Eq. 11), finest first. Each is widened
/// by the smaller of `margin_m` and the maximum kernel (otherwise a scene of kilometres would use
/// the finest map mostly for margins). Against shimmer while the camera moves, sides grow in steps
/// of 2^¼ and corners move by whole texels. Zhang et al. 2006; snapping after Valient 2008, "Stable
/// rendering of cascaded shadow maps". Deviation: boxes in place of bounding spheres, which are up
/// to three times as large; a rotating camera thus changes the texel size, at the steps only.
std::vector<LightWindow> FitWindowsToView(const LightAxes& axes, const View& view, int partitions,
                                          double split_weight, std::span<const int> resolutions,
                                          const LightExtent& scene, double margin_m);

/// Windows that do not depend on the camera. The finest covers `focus`, and with it all points that
/// `focus` can shade or be shaded by, because shadows move along the rays, which project to points
/// in the window. The last covers `scene`; those between grow geometrically. Every window is
/// widened by `margin_m`.
std::vector<LightWindow> FitWindowsToRegion(const LightAxes& axes, const Box& focus,
                                            const Box& scene, int partitions, double margin_m);

}  // namespace pleinair::shadows
