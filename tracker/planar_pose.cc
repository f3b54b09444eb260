#include "tracker/planar_pose.h"

#include <ceres/jet.h>
#include <ceres/rotation.h>
#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <utility>
#include <vector>

#include "tracker/homography.h"

namespace pleinair::tracker {
namespace {

/// Two refined solutions closer than this are one.
constexpr double kSameRotation_rad = 1e-3;
/// Difference of χ² below which the corners do not decide between two poses.
constexpr double kUndecided = 9.0;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

std::array<Vec3, 4> CornersInMarker(Metres size) {
  std::array<Vec3, 4> corners;
  for (int i = 0; i < 4; ++i) {
    const Vec2 corner = kSquareCorners[i] * (0.5 * size.value());
    corners[i] = {corner.x, corner.y, 0.0};
  }
  return corners;
}

/// Whitened reprojection errors as a function of the left perturbation (w, d) of a pose:
/// camera_from_marker' = (Exp(w) R, t + d).
struct WhitenedCorners {
  const CameraModel& camera;
  const std::array<Vec3, 4>& corners_in_marker;
  const std::array<Vec2, 4>& corners_px;
  const Matrix8& whitening;  ///< Lower-triangular inverse of the covariance's Cholesky factor.
  const Transform<Camera, Marker>& pose;

  template <typename T>
  bool operator()(const T* perturbation, T* residuals) const {
    std::array<T, 8> errors;
    for (int i = 0; i < 4; ++i) {
      const Vec3 rotated = pose.rotation * corners_in_marker[i];
      const T before[3] = {T(rotated.x), T(rotated.y), T(rotated.z)};
      T after[3];
      ceres::AngleAxisRotatePoint(perturbation, before, after);
      const T x = after[0] + pose.translation_m.x + perturbation[3];
      const T y = after[1] + pose.translation_m.y + perturbation[4];
      const T z = after[2] + pose.translation_m.z + perturbation[5];
      if (z <= T(1e-9)) return false;
      T u, v;
      ProjectToPixel(camera, x, y, z, &u, &v);
      errors[2 * i] = u - corners_px[i].x;
      errors[2 * i + 1] = v - corners_px[i].y;
    }
    for (int r = 0; r < 8; ++r) {
      residuals[r] = T(0);
      for (int c = 0; c <= r; ++c) residuals[r] += whitening(r, c) * errors[c];
    }
    return true;
  }
};

Transform<Camera, Marker> Perturbed(const Transform<Camera, Marker>& pose,
                                    const Vector6& perturbation) {
  const Eigen::Vector3d w = perturbation.head<3>();
  Eigen::Matrix3d exp = Eigen::Matrix3d::Identity();
  if (w.norm() > 0.0) exp = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
  Eigen::Matrix3d rotation =
      exp * Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.rotation.m.data());
  rotation = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  Transform<Camera, Marker> perturbed;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(perturbed.rotation.m.data()) = rotation;
  perturbed.translation_m =
      pose.translation_m + Vec3{perturbation[3], perturbation[4], perturbation[5]};
  return perturbed;
}

struct Refined {
  PoseSolution solution;
  double cost = 0.0;  ///< Squared Mahalanobis length of the reprojection error.
  PoseCovariance covariance{};
};

class PlanarPoseProblem {
 public:
  PlanarPoseProblem(const CameraModel& camera, const std::array<Vec2, 4>& corners_px,
                    const Matrix8& whitening, Metres size)
      : camera_(camera),
        corners_px_(corners_px),
        whitening_(whitening),
        corners_in_marker_(CornersInMarker(size)) {}

  /// Starts of both solutions; empty when there is none.
  std::vector<Transform<Camera, Marker>> Starts() const {
    std::vector<cv::Point3d> object;
    std::vector<cv::Point2d> image;
    for (int i = 0; i < 4; ++i) {
      object.emplace_back(corners_in_marker_[i].x, corners_in_marker_[i].y, 0.0);
      const Vec2 ray = UndistortPixel(camera_, corners_px_[i]);
      image.emplace_back(ray.x, ray.y);
    }
    std::vector<Transform<Camera, Marker>> starts;
    std::vector<cv::Mat> rotations, translations;
    try {
      cv::solvePnPGeneric(object, image, cv::Matx33d::eye(), cv::noArray(), rotations, translations,
                          false, cv::SOLVEPNP_IPPE);
    } catch (const cv::Exception&) {
      return starts;  // Degenerate corners: no pose.
    }
    for (std::size_t i = 0; i < rotations.size(); ++i) {
      cv::Matx33d rotation;
      cv::Rodrigues(rotations[i], rotation);
      Transform<Camera, Marker> start;
      std::copy(rotation.val, rotation.val + 9, start.rotation.m.begin());
      const cv::Vec3d translation(translations[i].ptr<double>());
      start.translation_m = {translation[0], translation[1], translation[2]};
      bool finite = start.translation_m.z > 0.0;
      for (const double value : start.rotation.m) finite = finite && std::isfinite(value);
      if (finite) starts.push_back(start);
    }
    return starts;
  }

  std::optional<Refined> Refine(Transform<Camera, Marker> pose) const {
    using Function = ceres::TinySolverAutoDiffFunction<WhitenedCorners, 8, 6>;
    // Each round starts again from its own pose, so that the perturbation stays small and its
    // derivatives are those of the covariance's convention.
    for (int round = 0; round < 2; ++round) {
      const WhitenedCorners errors{camera_, corners_in_marker_, corners_px_, whitening_, pose};
      const Function function(errors);
      ceres::TinySolver<Function> solver;
      solver.options.max_num_iterations = 50;
      Vector6 perturbation = Vector6::Zero();
      solver.Solve(function, &perturbation);
      if (!perturbation.allFinite()) return std::nullopt;
      pose = Perturbed(pose, perturbation);
    }
    const WhitenedCorners errors{camera_, corners_in_marker_, corners_px_, whitening_, pose};
    const Function function(errors);
    Vector8 residuals;
    Eigen::Matrix<double, 8, 6> jacobian;
    const Vector6 here = Vector6::Zero();
    if (!function(here.data(), residuals.data(), jacobian.data()) || !residuals.allFinite()) {
      return std::nullopt;
    }
    Refined refined;
    refined.solution = {pose, ReprojectionRms(pose)};
    refined.cost = residuals.squaredNorm();
    // Metres and radians differ in size: scale before inverting.
    const Vector6 size = jacobian.colwise().norm();
    if (!(size.minCoeff() > 0.0)) return std::nullopt;
    const Eigen::Matrix<double, 8, 6> scaled = jacobian * size.cwiseInverse().asDiagonal();
    const Eigen::Matrix<double, 6, 6> information = scaled.transpose() * scaled;
    const Eigen::Matrix<double, 6, 6> inverse =
        information.ldlt().solve(Eigen::Matrix<double, 6, 6>::Identity());
    const Eigen::Matrix<double, 6, 6> covariance =
        size.cwiseInverse().asDiagonal() * inverse * size.cwiseInverse().asDiagonal();
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(refined.covariance.data()) =
        0.5 * (covariance + covariance.transpose());
    return refined;
  }

 private:
  double ReprojectionRms(const Transform<Camera, Marker>& pose) const {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
      const Vec2 error =
          ProjectToPixel(camera_, pose * Point<Marker>{corners_in_marker_[i]}) - corners_px_[i];
      sum += error.x * error.x + error.y * error.y;
    }
    return std::sqrt(sum / 4.0);
  }

  const CameraModel& camera_;
  const std::array<Vec2, 4>& corners_px_;
  const Matrix8& whitening_;
  const std::array<Vec3, 4> corners_in_marker_;
};

double AngleBetween(const Mat3& a, const Mat3& b) {
  const Mat3 difference = a * b.Transposed();
  const double cosine = 0.5 * (difference(0, 0) + difference(1, 1) + difference(2, 2) - 1.0);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

CornerCovariance IsotropicCornerCovariance(double sigma_px) {
  CornerCovariance covariance{};
  for (int i = 0; i < 8; ++i) covariance[9 * i] = sigma_px * sigma_px;
  return covariance;
}

std::optional<PoseEstimate> EstimatePlanarPose(const CameraModel& camera,
                                               const std::array<Vec2, 4>& corners_px,
                                               const CornerCovariance& corner_covariance_px2,
                                               Metres size, const Mat3* likely_rotation) {
  const Eigen::LLT<Matrix8> cholesky(
      Eigen::Map<const Eigen::Matrix<double, 8, 8, Eigen::RowMajor>>(corner_covariance_px2.data()));
  if (cholesky.info() != Eigen::Success) return std::nullopt;
  const Matrix8 whitening = cholesky.matrixL().solve(Matrix8::Identity());
  const PlanarPoseProblem problem(camera, corners_px, whitening, size);
  std::vector<Refined> solutions;
  for (const Transform<Camera, Marker>& start : problem.Starts()) {
    if (std::optional<Refined> refined = problem.Refine(start)) solutions.push_back(*refined);
  }
  if (solutions.empty()) return std::nullopt;
  std::stable_sort(solutions.begin(), solutions.end(),
                   [](const Refined& a, const Refined& b) { return a.cost < b.cost; });
  if (likely_rotation != nullptr && solutions.size() > 1 &&
      solutions[1].cost - solutions[0].cost < kUndecided) {
    const auto angle = [&](const Refined& refined) {
      return AngleBetween(refined.solution.camera_from_marker.rotation, *likely_rotation);
    };
    if (angle(solutions[1]) < angle(solutions[0])) std::swap(solutions[0], solutions[1]);
  }
  PoseEstimate estimate;
  estimate.best = solutions[0].solution;
  estimate.covariance = solutions[0].covariance;
  if (solutions.size() > 1 &&
      AngleBetween(solutions[0].solution.camera_from_marker.rotation,
                   solutions[1].solution.camera_from_marker.rotation) > kSameRotation_rad) {
    estimate.alternative = solutions[1].solution;
    const double worse = estimate.alternative->reprojection_rms_px;
    if (worse > 0.0) {
      estimate.ambiguity_ratio = std::min(1.0, estimate.best.reprojection_rms_px / worse);
    }
  }
  return estimate;
}

}  // namespace pleinair::tracker
