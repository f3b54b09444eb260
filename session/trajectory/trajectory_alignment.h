#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/vector.h"
#include "session/trajectory/given_trajectory.h"

namespace pleinair::session {

/// A similarity from the trajectory's frame of reference to the marker's:
/// x_marker = scale · R x_trajectory + t.
struct TrajectorySimilarity {
  double scale = 1.0;  ///< Metres of one unit of the trajectory.
  Mat3 rotation;
  Vec3 translation_m;

  Transform<Marker, Camera> operator*(const Transform<TrajectoryWorld, Camera>& pose) const {
    return {rotation * pose.rotation, rotation * pose.translation_m * scale + translation_m};
  }
  Point<Marker> operator*(Point<TrajectoryWorld> point) const {
    return {rotation * point.xyz * scale + translation_m};
  }
};

/// 7×7 covariance, row-major: rotation vector w (rad), translation d (m), logarithm l of the scale.
/// The true similarity has the rotation Exp(w) R, the translation t + d and the scale e^l s. Rows
/// of a known scale are 0.
using SimilarityCovariance = std::array<double, 49>;

/// Estimated similarity of a trajectory to the marker's frame, with its quality.
struct TrajectoryAlignment {
  TrajectorySimilarity marker_from_trajectory;
  SimilarityCovariance covariance{};
  std::size_t used = 0;      ///< Views or pairs.
  std::size_t outliers = 0;  ///< Views that contradict the others, of `used`.
  /// Root mean square of the residuals of all but outliers: pixels for views, metres for pairs.
  double residual_rms = 0.0;
  double residual_max = 0.0;
  /// Chi-square over its degrees of freedom, for views. 1: the covariances explain the residuals.
  double chi2_per_dof = 0.0;
};

/// The marker in a frame whose pose the trajectory has.
struct TrajectoryView {
  Transform<TrajectoryWorld, Camera> world_from_camera;
  Transform<Camera, Marker> camera_from_marker;  ///< By the marker itself.
  std::array<Vec2, 4> corners_px{};              ///< Clockwise from top-left.
  double deviation_px = 0.1;                     ///< Standard deviation of each coordinate.
};

/// Aligns a trajectory by the frames that show the marker. Minimises the squared distances of all
/// corners from their projections, in units of their standard deviations. Steps are Gauss and
/// Newton's with the damping of Levenberg 1944 and Marquardt 1963. Views farther than twice the
/// median distance, at least 2 standard deviations, lose weight (Huber 1964, "Robust estimation of
/// a location parameter"). Views beyond three times that limit are outliers. `is_metric`: the scale
/// stays 1. The covariance is the inverse of the normal equations, times chi2_per_dof where that
/// exceeds 1. Errors, which name `file`: no view; a free scale that the views do not determine
/// within 5 %; views that no similarity fits.
Result<TrajectoryAlignment> AlignByMarker(const CameraModel& camera, double marker_size_m,
                                          const std::vector<TrajectoryView>& views, bool is_metric,
                                          const std::string& file);

/// Root mean square distance, pixels, of a view's four corners from those that the similarity
/// projects. Infinite behind the camera.
double CornerDistance_px(const CameraModel& camera, double marker_size_m,
                         const TrajectorySimilarity& similarity, const TrajectoryView& view);

/// Standard deviation of the marker's centre as a camera of the trajectory sees it, metres: the
/// root of the summed variances of its three coordinates. It holds the errors of the alignment, not
/// those of the trajectory.
double CentreDeviation_m(const TrajectoryAlignment& alignment,
                         const Transform<TrajectoryWorld, Camera>& world_from_camera);

}  // namespace pleinair::session
