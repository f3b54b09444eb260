#include "session/motion/path_motion.h"

#include <cmath>

namespace pleinair::session {
namespace {

constexpr double kAround_s = 0.6;
/// Time over which hands change their motion, and the variance of a pose's noise relative to that
/// of the motion.
constexpr double kScale_s = 0.2;
constexpr double kNoiseShare = 1e-3;
constexpr double kPerNanosecond = 1e-9;

using SixCoordinates = Eigen::Matrix<double, 1, 6>;
using Rotation = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Rotation against `origin` as a vector, then translation.
SixCoordinates SixOf(const Transform<Camera, Marker>& pose, const Mat3& origin) {
  const Mat3 relative = pose.rotation * origin.Transposed();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(Eigen::Map<const Rotation>(relative.m.data())));
  const Eigen::Vector3d vector = turn.angle() * turn.axis();
  SixCoordinates six;
  six << vector.x(), vector.y(), vector.z(), pose.translation_m.x, pose.translation_m.y,
      pose.translation_m.z;
  return six;
}

Transform<Camera, Marker> PoseOfSix(const SixCoordinates& six, const Mat3& origin) {
  const Eigen::Vector3d vector = six.head<3>().transpose();
  Rotation turn = Rotation::Identity();
  if (vector.norm() > 0.0) {
    turn = Eigen::AngleAxisd(vector.norm(), vector.normalized()).toRotationMatrix();
  }
  Mat3 rotation;
  Eigen::Map<Rotation>(rotation.m.data()) = turn;
  return {rotation * origin, {six[3], six[4], six[5]}};
}

}  // namespace

PathMotion::PathMotion(const std::vector<Observation>& path, std::size_t before)
    : origin_(path[before].camera_from_marker.rotation),
      start_ns_(path[before].timestamp_ns),
      length_s_(Seconds(path[before + 1].timestamp_ns)) {
  std::size_t first = before, last = before + 1;
  while (first > 0 && Seconds(path[first - 1].timestamp_ns) >= -kAround_s) --first;
  while (last + 1 < path.size() && Seconds(path[last + 1].timestamp_ns) <= length_s_ + kAround_s) {
    ++last;
  }
  const auto count = static_cast<Eigen::Index>(last - first + 1);
  Eigen::MatrixXd values(count, 6), line(count, 2), covariance(count, count);
  times_s_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Observation& at = path[first + static_cast<std::size_t>(i)];
    times_s_[i] = Seconds(at.timestamp_ns);
    values.row(i) = SixOf(at.camera_from_marker, origin_);
    line.row(i) << 1.0, times_s_[i];
  }
  for (Eigen::Index i = 0; i < count; ++i) covariance.col(i) = Covariances(times_s_[i]);
  covariance.diagonal().array() += kNoiseShare;
  const Eigen::LDLT<Eigen::MatrixXd> factor(covariance);
  line_ =
      (line.transpose() * factor.solve(line)).ldlt().solve(line.transpose() * factor.solve(values));
  weights_ = factor.solve(values - line * line_);
  left_ = SixOf(path[before].camera_from_marker, origin_) - Fitted(0.0);
  right_ = SixOf(path[before + 1].camera_from_marker, origin_) - Fitted(length_s_);
}

Transform<Camera, Marker> PathMotion::At(std::int64_t timestamp_ns) const {
  const double at_s = Seconds(timestamp_ns), share = at_s / length_s_;
  return PoseOfSix(Fitted(at_s) + (1.0 - share) * left_ + share * right_, origin_);
}

double PathMotion::Seconds(std::int64_t timestamp_ns) const {
  return static_cast<double>(timestamp_ns - start_ns_) * kPerNanosecond;
}

Eigen::VectorXd PathMotion::Covariances(double at_s) const {
  return (-0.5 * ((times_s_.array() - at_s) / kScale_s).square()).exp();
}

PathMotion::SixNumbers PathMotion::Fitted(double at_s) const {
  return line_.row(0) + at_s * line_.row(1) + Covariances(at_s).transpose() * weights_;
}

}  // namespace pleinair::session
