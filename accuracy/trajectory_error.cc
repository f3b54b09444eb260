#include "accuracy/trajectory_error.h"

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "accuracy/scoring.h"
#include "base/units.h"

namespace pleinair::accuracy {
namespace {

using Pose = Transform<Marker, Camera>;

struct Match {
  std::size_t place;  ///< Index in the ground truth.
  const Pose* found;
  const Pose* truth;
};

std::vector<Match> MatchByTime(const Trajectory& found, const Trajectory& truth) {
  std::vector<Match> matches;
  std::size_t at = 0;
  for (const TimedPose& pose : found) {
    while (at < truth.size() && truth[at].timestamp_ns < pose.timestamp_ns) ++at;
    if (at == truth.size()) break;
    if (truth[at].timestamp_ns == pose.timestamp_ns) {
      matches.push_back({at, &pose.marker_from_camera, &truth[at].marker_from_camera});
    }
  }
  return matches;
}

/// RMS distance of camera positions after the rigid alignment that minimises it: Umeyama 1991,
/// "Least-squares estimation of transformation parameters between two point patterns", without
/// scale. Sturm et al. 2012, Eq. (3) and the text after it.
double AlignedRmse(const std::vector<Match>& matches) {
  Eigen::Matrix3Xd found(3, matches.size()), truth(3, matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Vec3 a = matches[i].found->translation_m, b = matches[i].truth->translation_m;
    found.col(column) << a.x, a.y, a.z;
    truth.col(column) << b.x, b.y, b.z;
  }
  const Eigen::Matrix4d motion = Eigen::umeyama(found, truth, false);
  const Eigen::Matrix3Xd moved =
      (motion.topLeftCorner<3, 3>() * found).colwise() + motion.topRightCorner<3, 1>();
  return std::sqrt((moved - truth).colwise().squaredNorm().mean());
}

}  // namespace

std::optional<TrajectoryError> CompareTrajectories(const Trajectory& found,
                                                   const Trajectory& truth) {
  const std::vector<Match> matches = MatchByTime(found, truth);
  if (matches.empty()) return std::nullopt;
  TrajectoryError error{.poses = static_cast<std::int64_t>(matches.size())};
  // Fewer than three points do not determine the alignment, and its residual is 0.
  if (matches.size() >= 3) error.ate_rmse_m = AlignedRmse(matches);
  double unaligned2 = 0.0, translation2 = 0.0, rotation2 = 0.0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double away = Norm(matches[i].found->translation_m - matches[i].truth->translation_m);
    unaligned2 += away * away;
    if (i == 0 || matches[i].place != matches[i - 1].place + 1) continue;
    // Sturm et al. 2012, Eq. (1): E = (Q_i⁻¹ Q_{i+Δ})⁻¹ (P_i⁻¹ P_{i+Δ}), Q the truth, Δ = 1.
    const auto truth_step = matches[i - 1].truth->Inverse() * *matches[i].truth;
    const auto found_step = matches[i - 1].found->Inverse() * *matches[i].found;
    const auto difference = truth_step.Inverse() * found_step;
    translation2 += Dot(difference.translation_m, difference.translation_m);
    const double angle_deg = ToDegrees(Radians(AngleBetween(difference.rotation, Mat3{})));
    rotation2 += angle_deg * angle_deg;
    ++error.steps;
  }
  error.ate_unaligned_rmse_m = std::sqrt(unaligned2 / static_cast<double>(error.poses));
  if (error.steps > 0) {
    error.rpe_translation_rmse_m = std::sqrt(translation2 / static_cast<double>(error.steps));
    error.rpe_rotation_rmse_deg = std::sqrt(rotation2 / static_cast<double>(error.steps));
  }
  return error;
}

}  // namespace pleinair::accuracy
