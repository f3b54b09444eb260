#include "accuracy/scoring.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pleinair::accuracy {
namespace {

double Rms(const std::array<Vec2, 4>& errors) {
  double sum = 0.0;
  for (const Vec2 error : errors) sum += error.x * error.x + error.y * error.y;
  return std::sqrt(sum / 4.0);
}

std::array<Vec2, 4> Less(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  std::array<Vec2, 4> difference;
  for (int i = 0; i < 4; ++i) difference[i] = a[i] - b[i];
  return difference;
}

/// Rotation vector of a rotation (the inverse of Exp).
Eigen::Vector3d LogOf(const Mat3& rotation) {
  const Eigen::Matrix3d matrix =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.m.data());
  const Eigen::AngleAxisd turn(matrix);
  return turn.angle() * turn.axis();
}

PoseRecord PoseRecordOf(const Detected& detected, const Transform<Camera, Marker>& truth) {
  const tracker::PoseEstimate& pose = *detected.pose;
  PoseRecord record{.camera_from_marker = pose.best.camera_from_marker};
  record.rotation_error_deg =
      ToDegrees(Radians(AngleBetween(truth.rotation, record.camera_from_marker.rotation)));
  record.translation_error_m = Norm(record.camera_from_marker.translation_m - truth.translation_m);
  record.ambiguity_ratio = pose.ambiguity_ratio;
  if (detected.pose_has_covariance) record.nees = Nees(pose, truth);
  if (pose.alternative) {
    record.alternative_error_deg = ToDegrees(
        Radians(AngleBetween(truth.rotation, pose.alternative->camera_from_marker.rotation)));
  }
  return record;
}

}  // namespace

double MarkerRecord::CornerRms() const { return Rms(corner_error_px); }

double MarkerRecord::TrueEdge() const {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += Norm(true_corners_px[i] - true_corners_px[(i + 1) % 4]);
  return sum / 4.0;
}

bool IsFilm(const FrameRecord& record) {
  return record.sweep.starts_with("sequence") || record.sweep == kRecordingSweep;
}

double AngleBetween(const Mat3& a, const Mat3& b) {
  // Computed from the chord: the cosine is imprecise near 0.
  double square = 0.0;
  for (int i = 0; i < 9; ++i) square += (a.m[i] - b.m[i]) * (a.m[i] - b.m[i]);
  return 2.0 * std::asin(std::min(1.0, std::sqrt(square / 8.0)));
}

std::optional<double> Nees(const tracker::PoseEstimate& estimate,
                           const Transform<Camera, Marker>& truth) {
  using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  const Transform<Camera, Marker>& found = estimate.best.camera_from_marker;
  const Vec3 away = truth.translation_m - found.translation_m;
  Eigen::Matrix<double, 6, 1> error;
  error << LogOf(truth.rotation * found.rotation.Transposed()), away.x, away.y, away.z;
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> factor(
      Eigen::Map<const Matrix6>(estimate.covariance.data()));
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.matrixL().solve(error).squaredNorm();
}

void Score(const std::vector<MarkerTruth>& truth, const std::vector<Detected>& detected,
           FrameRecord* record) {
  constexpr double kTolerance_px = 2.0, kToleranceShare = 0.03;
  std::vector<bool> used(detected.size());
  for (const MarkerTruth& there : truth) {
    MarkerRecord marker{.number = there.number,
                        .true_camera_from_marker = there.camera_from_marker,
                        .true_corners_px = there.corners_px,
                        .border_covered = there.covered.border,
                        .content_covered = there.covered.content};
    int nearest = -1;
    double least = 0.0;
    for (std::size_t i = 0; i < detected.size(); ++i) {
      if (used[i] || detected[i].number != there.number) continue;
      const double rms = Rms(Less(detected[i].corners_px, there.corners_px));
      if (nearest >= 0 && rms >= least) continue;
      nearest = static_cast<int>(i);
      least = rms;
    }
    if (nearest >= 0) {
      used[nearest] = true;
      const Detected& found = detected[nearest];
      marker.corner_error_px = Less(found.corners_px, there.corners_px);
      marker.visible_fraction = found.visible_fraction;
      marker.path = found.path;
      const bool hit = least < std::max(kTolerance_px, kToleranceShare * marker.TrueEdge());
      marker.outcome = hit ? Outcome::kHit : Outcome::kMisplaced;
      if (hit && found.pose) marker.pose = PoseRecordOf(found, there.camera_from_marker);
    }
    record->markers.push_back(std::move(marker));
  }
  record->false_numbers = static_cast<int>(std::count(used.begin(), used.end(), false));
}

}  // namespace pleinair::accuracy
