#pragma once

#include <cmath>
#include <limits>

namespace pleinair::compositor {

/// Shape of a lens's stop: round, or a regular polygon of straight blades. The corners lie on the
/// circle whose diameter is the aperture.
struct LensStop {
  int blades = 0;             ///< 0: round; else 3…16.
  double rotation_rad = 0.0;  ///< One corner's angle from the image's right, clockwise.
  bool operator==(const LensStop&) const = default;
};

/// A thin lens that is focused on a plane facing the camera. With a calibrated camera nothing else
/// of the lens matters: Schedl and Wimmer 2012, Eq. 1, divided by the pixel pitch.
struct ThinLens {
  double aperture_m = 0.0;      ///< Diameter D of the entrance pupil.
  double focus_dioptres = 0.0;  ///< Reciprocal distance 1/z_f of the plane in focus; 0: infinity.
  LensStop stop = {};
  bool operator==(const ThinLens&) const = default;

  /// Circles are not drawn larger than that at this distance, 2 D.
  double MinDistance_m() const { return 2.0 * aperture_m; }
};

/// Diameter of the circle of confusion, pixels, positive behind the focus: d = fx D (1/z_f − 1/z).
/// `dioptres`: 1/z along the optical axis, 1/m.
inline double SignedCircle_px(const ThinLens& lens, double fx, double dioptres) {
  return fx * lens.aperture_m * (lens.focus_dioptres - dioptres);
}

/// Diameter of the circle of confusion of a point at `distance_m` > 0 along the optical axis,
/// pixels. Infinity is a distance, too.
inline double CircleOfConfusion_px(const ThinLens& lens, double fx, double distance_m) {
  return std::fabs(SignedCircle_px(lens, fx, 1.0 / distance_m));
}

/// The inverse in front of the focus: the distance whose circle has `diameter_px` (Eq. 6).
inline double DistanceBeforeFocus_m(const ThinLens& lens, double fx, double diameter_px) {
  return 1.0 / (lens.focus_dioptres + diameter_px / (fx * lens.aperture_m));
}

/// The inverse behind the focus (Eq. 7). Infinity for circles that no distance has (Eq. 8): those
/// of fx D / z_f and more.
inline double DistanceBehindFocus_m(const ThinLens& lens, double fx, double diameter_px) {
  const double dioptres = lens.focus_dioptres - diameter_px / (fx * lens.aperture_m);
  return dioptres > 0.0 ? 1.0 / dioptres : std::numeric_limits<double>::infinity();
}

}  // namespace pleinair::compositor
