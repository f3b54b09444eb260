#include "session/trajectory/trajectory_alignment.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/quantile.h"
#include "session/marker_tracks.h"
#include "session/trajectory/alignment_numbers.h"

namespace pleinair::session {
namespace {

using ViewJacobian = Eigen::Matrix<double, 8, 7>;
using ViewResidual = Eigen::Matrix<double, 8, 1>;

constexpr double kNearest_m = 1e-6;  // In front of the camera.

std::array<Vec3, 4> CornersOf(double size_m) {
  const double half = 0.5 * size_m;
  return {{{-half, half, 0}, {half, half, 0}, {half, -half, 0}, {-half, -half, 0}}};
}

/// Derivative of the pixel by the point in the camera's frame.
Eigen::Matrix<double, 2, 3> PixelByPoint(const CameraModel& camera, const Eigen::Vector3d& point) {
  const double step = 1e-6 * point.norm();
  Eigen::Matrix<double, 2, 3> by;
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d up = point, down = point;
    up[k] += step;
    down[k] -= step;
    const Vec2 high = ProjectToPixel(camera, Point<Camera>{VecOf(up)});
    const Vec2 low = ProjectToPixel(camera, Point<Camera>{VecOf(down)});
    by(0, k) = (high.x - low.x) / (2.0 * step);
    by(1, k) = (high.y - low.y) / (2.0 * step);
  }
  return by;
}

/// Residuals of a view in standard deviations, and their derivatives if wanted. Nothing: a corner
/// is behind the camera.
std::optional<ViewResidual> ResidualOf(const CameraModel& camera, double size_m,
                                       const TrajectorySimilarity& similarity,
                                       const TrajectoryView& view, ViewJacobian* jacobian) {
  const Eigen::Matrix3d camera_from_marker =
      (EigenOf(similarity.rotation) * EigenOf(view.world_from_camera.rotation)).transpose();
  const Eigen::Vector3d arm = similarity.scale * (EigenOf(similarity.rotation) *
                                                  EigenOf(view.world_from_camera.translation_m));
  const Eigen::Vector3d shift = EigenOf(similarity.translation_m);
  const std::array<Vec3, 4> corners = CornersOf(size_m);
  ViewResidual residual;
  for (int i = 0; i < 4; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Eigen::Vector3d from_origin = EigenOf(corners[at]) - shift;
    const Eigen::Vector3d point = camera_from_marker * (from_origin - arm);
    if (!(point.z() > kNearest_m)) return std::nullopt;
    const Vec2 pixel = ProjectToPixel(camera, Point<Camera>{VecOf(point)});
    residual[2 * i] = (pixel.x - view.corners_px[at].x) / view.deviation_px;
    residual[2 * i + 1] = (pixel.y - view.corners_px[at].y) / view.deviation_px;
    if (jacobian == nullptr) continue;
    Eigen::Matrix<double, 3, 7> by;
    by.leftCols<3>() = camera_from_marker * CrossMatrix(from_origin);
    by.middleCols<3>(3) = -camera_from_marker;
    by.col(kScaleIndex) = -camera_from_marker * arm;
    jacobian->middleRows<2>(2 * i) = PixelByPoint(camera, point) * by / view.deviation_px;
  }
  if (!residual.allFinite()) return std::nullopt;
  return residual;
}

/// The similarity of a rotation that fits the positions of the cameras best.
TrajectorySimilarity WithRotation(const Mat3& rotation, const std::vector<TrajectoryView>& views,
                                  bool is_metric) {
  Eigen::Vector3d mean_from = Eigen::Vector3d::Zero(), mean_to = Eigen::Vector3d::Zero();
  const auto count = static_cast<double>(views.size());
  for (const TrajectoryView& view : views) {
    mean_from += EigenOf(rotation * view.world_from_camera.translation_m) / count;
    mean_to += EigenOf(view.camera_from_marker.Inverse().translation_m) / count;
  }
  double product = 0.0, square = 0.0;
  for (const TrajectoryView& view : views) {
    const Eigen::Vector3d from =
        EigenOf(rotation * view.world_from_camera.translation_m) - mean_from;
    product += from.dot(EigenOf(view.camera_from_marker.Inverse().translation_m) - mean_to);
    square += from.squaredNorm();
  }
  TrajectorySimilarity similarity;
  if (!is_metric && product > 0.0 && square > 0.0) similarity.scale = product / square;
  similarity.rotation = rotation;
  similarity.translation_m = VecOf(mean_to - similarity.scale * mean_from);
  return similarity;
}

/// A start whose rotation is nearest to those of all views: a view with the wrong one of two planar
/// poses does not count.
TrajectorySimilarity StartOf(const std::vector<TrajectoryView>& views, bool is_metric) {
  constexpr std::size_t kMaxCandidates = 60;
  const std::size_t stride = views.size() / kMaxCandidates + 1;
  std::vector<Mat3> rotations;
  for (std::size_t i = 0; i < views.size(); i += stride) {
    rotations.push_back(views[i].camera_from_marker.rotation.Transposed() *
                        views[i].world_from_camera.rotation.Transposed());
  }
  double least = std::numeric_limits<double>::infinity();
  Mat3 best;
  for (const Mat3& one : rotations) {
    double sum = 0.0;
    for (const Mat3& other : rotations) sum += RotationAngle(one, other);
    if (sum >= least) continue;
    least = sum;
    best = one;
  }
  return WithRotation(best, views, is_metric);
}

TrajectorySimilarity Moved(const TrajectorySimilarity& from, const Seven& step) {
  TrajectorySimilarity moved = from;
  const Eigen::Vector3d turn = step.head<3>();
  if (turn.norm() > 0.0) {
    const Eigen::AngleAxisd by(turn.norm(), turn.normalized());
    moved.rotation = MatOf(by.toRotationMatrix() * EigenOf(from.rotation));
  }
  moved.translation_m = from.translation_m + VecOf(step.segment<3>(3));
  moved.scale = from.scale * std::exp(step[kScaleIndex]);
  return moved;
}

/// Distances of the views in standard deviations, by view; infinite behind the camera.
std::vector<double> DistancesOf(const CameraModel& camera, double size_m,
                                const TrajectorySimilarity& similarity,
                                const std::vector<TrajectoryView>& views) {
  std::vector<double> distances;
  distances.reserve(views.size());
  for (const TrajectoryView& view : views) {
    const auto residual = ResidualOf(camera, size_m, similarity, view, nullptr);
    distances.push_back(residual ? std::sqrt(residual->squaredNorm() / 8.0)
                                 : std::numeric_limits<double>::infinity());
  }
  return distances;
}

constexpr double kHuber = 2.0;

/// Distance at which views begin to lose weight.
double HuberLimit(const std::vector<double>& distances) {
  return kHuber * std::max(1.0, Median(distances));
}

double RobustCost(const std::vector<double>& distances, double limit) {
  double cost = 0.0;
  for (const double d : distances) cost += d <= limit ? d * d : limit * (2.0 * d - limit);
  return cost;
}

NormalEquations EquationsOf(const CameraModel& camera, double size_m,
                            const TrajectorySimilarity& similarity,
                            const std::vector<TrajectoryView>& views, double limit) {
  NormalEquations equations;
  for (const TrajectoryView& view : views) {
    ViewJacobian jacobian;
    const auto residual = ResidualOf(camera, size_m, similarity, view, &jacobian);
    if (!residual) continue;
    const double distance = std::sqrt(residual->squaredNorm() / 8.0);
    const double weight = distance <= limit ? 1.0 : limit / distance;
    equations.matrix += weight * jacobian.transpose() * jacobian;
    equations.gradient += weight * jacobian.transpose() * *residual;
  }
  return equations;
}

/// Gauss and Newton's steps, shortened by Levenberg and Marquardt's rule while they do not improve.
TrajectorySimilarity Refined(const CameraModel& camera, double size_m,
                             const std::vector<TrajectoryView>& views, bool is_metric,
                             TrajectorySimilarity similarity) {
  constexpr int kMaxSteps = 40;
  constexpr double kDone = 1e-10, kMaxDamping = 1e8;
  double damping = 1e-6;
  for (int i = 0; i < kMaxSteps && damping < kMaxDamping; ++i) {
    const std::vector<double> distances = DistancesOf(camera, size_m, similarity, views);
    const double limit = HuberLimit(distances), cost = RobustCost(distances, limit);
    NormalEquations equations = EquationsOf(camera, size_m, similarity, views, limit);
    Hold(is_metric, &equations);
    equations.matrix.diagonal() *= 1.0 + damping;
    const Seven step = -equations.matrix.ldlt().solve(equations.gradient);
    if (!step.allFinite()) break;
    const TrajectorySimilarity next = Moved(similarity, step);
    const double next_cost = RobustCost(DistancesOf(camera, size_m, next, views), limit);
    // Not above an infinite one.
    if (!(next_cost < cost) && !(cost > 1e300)) {
      if (step.norm() < kDone || cost - next_cost == 0.0) break;
      damping *= 10.0;
      continue;
    }
    similarity = next;
    damping = std::max(1e-9, damping * 0.1);
    if (step.norm() < kDone) break;
  }
  return similarity;
}

constexpr const char* kScaleRemedy =
    "show the marker in views from places that are farther apart, or give three places with "
    "--trajectory-points, or the trajectory's unit with --trajectory-scale";

tl::unexpected<Error> NoScale(const std::string& file) {
  return InputError(file,
                    "has no scale, and the frames with the marker do not determine it within 5 %: "
                    "they need two views from places that are apart",
                    kScaleRemedy);
}

}  // namespace

double CornerDistance_px(const CameraModel& camera, double marker_size_m,
                         const TrajectorySimilarity& similarity, const TrajectoryView& view) {
  const auto residual = ResidualOf(camera, marker_size_m, similarity, view, nullptr);
  // Over four corners of two coordinates each.
  return residual ? view.deviation_px * std::sqrt(residual->squaredNorm() / 4.0)
                  : std::numeric_limits<double>::infinity();
}

double CentreDeviation_m(const TrajectoryAlignment& alignment,
                         const Transform<TrajectoryWorld, Camera>& world_from_camera) {
  const TrajectorySimilarity& similarity = alignment.marker_from_trajectory;
  Eigen::Matrix<double, 3, 7> by;
  by.leftCols<3>() = CrossMatrix(-EigenOf(similarity.translation_m));
  by.middleCols<3>(3) = -Eigen::Matrix3d::Identity();
  by.col(kScaleIndex) =
      -EigenOf(similarity.rotation * world_from_camera.translation_m) * similarity.scale;
  const Eigen::Map<const SevenBySeven> covariance(alignment.covariance.data());
  return std::sqrt(std::max(0.0, (by * covariance * by.transpose()).trace()));
}

Result<TrajectoryAlignment> AlignByMarker(const CameraModel& camera, double marker_size_m,
                                          const std::vector<TrajectoryView>& views, bool is_metric,
                                          const std::string& file) {
  if (views.empty()) {
    return InputError(file, "has no pose in any frame that shows the marker",
                      "check --trajectory-offset-s, or give three places with "
                      "--trajectory-points");
  }
  if (!is_metric && views.size() < 2) return NoScale(file);
  TrajectoryAlignment alignment;
  TrajectorySimilarity& similarity = alignment.marker_from_trajectory;
  similarity = Refined(camera, marker_size_m, views, is_metric, StartOf(views, is_metric));
  const std::vector<double> distances = DistancesOf(camera, marker_size_m, similarity, views);
  const double limit = HuberLimit(distances);
  const auto inverse =
      std::isfinite(limit)
          ? InverseOf(EquationsOf(camera, marker_size_m, similarity, views, limit), is_metric)
          : std::nullopt;
  if (!inverse && !is_metric) return NoScale(file);
  if (!inverse) {
    return InputError(file, "does not fit the frames that show the marker",
                      "check its format, --trajectory-offset-s and --trajectory-turn-deg");
  }
  alignment.used = views.size();
  double chi2 = 0.0, squares_px2 = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    // Beyond three limits: a wrong detection, or a jump of the trajectory.
    if (distances[i] > 3.0 * limit) {
      ++alignment.outliers;
      continue;
    }
    const double px = CornerDistance_px(camera, marker_size_m, similarity, views[i]);
    chi2 += 8.0 * distances[i] * distances[i];
    squares_px2 += px * px;
    alignment.residual_max = std::max(alignment.residual_max, px);
  }
  const auto inliers = static_cast<double>(views.size() - alignment.outliers);
  alignment.residual_rms = std::sqrt(squares_px2 / inliers);
  alignment.chi2_per_dof = chi2 / std::max(1.0, 8.0 * inliers - (is_metric ? 6.0 : 7.0));
  const SevenBySeven covariance = *inverse * std::max(1.0, alignment.chi2_per_dof);
  constexpr double kMaxScaleDeviation = 0.05;
  if (std::sqrt(covariance(kScaleIndex, kScaleIndex)) > kMaxScaleDeviation) return NoScale(file);
  StoreCovariance(covariance, &alignment.covariance);
  return alignment;
}

}  // namespace pleinair::session
