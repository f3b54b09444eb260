#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>

#include "base/vector.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::tracker {

/// A fitted corner of a marker, and the derivatives of its pixel by its position on the marker.
struct FittedCorner {
  Vec2 unit;        ///< In the marker's plane, in half edges from its centre.
  Vec2 pixel;       ///< Observed position.
  Vec2 by_u, by_v;  ///< Pixels per half edge along the plane's axes.
};

/// `pixel_of` maps a point of the marker's plane (half edges) to its pixel.
template <typename PixelOf>
FittedCorner CornerAt(Vec2 unit, const PixelOf& pixel_of) {
  constexpr double kStep = 1e-4;
  const auto slope = [&](Vec2 step) {
    return (pixel_of(unit + step) - pixel_of(unit - step)) * (0.5 / kStep);
  };
  return {unit, pixel_of(unit), slope({kStep, 0.0}), slope({0.0, kStep})};
}

/// Covariance of corners (px², row-major, x and y of each in turn). `motion`: the row-major
/// covariance of the eight motion parameters m of a fit. m moves the observation at (u, v), in half
/// edges, by
///
///   (m0 + m1 u + m2 v − (m6 u + m7 v) u, m3 + m4 u + m5 v − (m6 u + m7 v) v).
///
/// `systematic_px` is an additional independent standard deviation of every coordinate.
CornerCovariance CovarianceOfCorners(const std::array<FittedCorner, 4>& corners,
                                     const std::array<double, 64>& motion, double systematic_px);

}  // namespace pleinair::tracker
