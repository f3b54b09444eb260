#pragma once

// Internal: not installed.

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/frames.h"
#include "session/marker_tracks.h"

namespace pleinair::session {

/// The camera's motion between two neighbouring poses of a path. Each coordinate of
/// `camera_from_marker` is a Gaussian process in time with a linear mean, given the poses within
/// 0.6 s on both sides. Source: Rasmussen & Williams 2006, "Gaussian Processes for Machine
/// Learning", Eqs. 2.31 and 2.41. The covariance is exp(-Δt² / (2 · 0.2² s²)), with a noise of
/// 1e-3. The differences from the two poses fade linearly from one to the other, so that nothing
/// jumps.
class PathMotion {
 public:
  /// The motion from `path[before]` to the next pose, which comes later.
  PathMotion(const std::vector<Observation>& path, std::size_t before);

  /// The pose at a time. A little before the first pose or after the second one, the motion goes
  /// on.
  Transform<Camera, Marker> At(std::int64_t timestamp_ns) const;

 private:
  using SixNumbers = Eigen::Matrix<double, 1, 6>;

  double Seconds(std::int64_t timestamp_ns) const;
  /// Covariances of the motion at `at_s` with that at the poses' times.
  Eigen::VectorXd Covariances(double at_s) const;
  SixNumbers Fitted(double at_s) const;

  Mat3 origin_;
  std::int64_t start_ns_ = 0;
  double length_s_ = 0.0;
  Eigen::VectorXd times_s_;
  Eigen::MatrixXd line_, weights_;
  SixNumbers left_, right_;
};

}  // namespace pleinair::session
