#include "tracker/pose/planar_pose.h"

#include <ceres/jet.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

/// Two refined solutions closer than this are the same.
constexpr double kSameRotation_rad = 1e-3;
/// Degrees of freedom of the Student's t distribution assumed for the corners' errors: their
/// covariance is itself an estimate, and Gaussian odds would be overconfident.
constexpr double kTailFreedom = 8.0;
/// Eight coordinates of corners less six parameters of the pose.
constexpr double kMisfitFreedom = 2.0;
/// Difference of χ² below which the corners do not decide between two poses.
constexpr double kUndecided = 9.0;

/// Levenberg–Marquardt: maximum steps, initial damping, and the step (radians, relative distance)
/// and cost reduction that count as converged. 1e-8 of χ² corresponds to 1e-4 of the corners'
/// standard deviation, and the remaining error is a small part of that.
constexpr int kMaxSteps = 60;
constexpr double kFirstDamping = 1e-6, kMaxDamping = 1e12, kStill = 1e-9, kNoGain = 1e-8;
/// Damping at which a step is practically undamped.
constexpr double kLittleDamping = 1e-3;

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
        size_(size),
        corners_in_marker_(CornersInMarker(size)) {}

  /// Both solutions of IPPE: the first-order plane homography at the square's centre gives the
  /// rotation up to a reflection. Collins & Bartoli 2014, §4; the steps as in OpenCV's ippe.cpp.
  /// Returns their number.
  int Starts(std::array<Transform<Camera, Marker>, 2>* starts) const {
    std::array<Vec2, 4> rays;
    for (int i = 0; i < 4; ++i) rays[i] = UndistortPixel(camera_, corners_px_[i]);
    const Mat3 h = HomographyToQuad(rays);
    const double scale = 1.0 / h(2, 2), p = h(0, 2) * scale, q = h(1, 2) * scale;
    const double g = h(2, 0) * scale, k = h(2, 1) * scale;
    Eigen::Matrix2d by_plane;  // Derivative of the ray by the position on the plane.
    by_plane << h(0, 0) * scale - g * p, h(0, 1) * scale - k * p,  //
        h(1, 0) * scale - g * q, h(1, 1) * scale - k * q;
    if (!by_plane.allFinite()) return 0;
    // Rotates the optical axis to the ray of the centre.
    const Eigen::Matrix3d to_ray =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), Eigen::Vector3d(p, q, 1.0))
            .toRotationMatrix();
    Eigen::Matrix<double, 2, 3> by_space;
    by_space << 1, 0, -p, 0, 1, -q;
    const Eigen::Matrix2d by_turned = (by_space * to_ray).leftCols<2>();
    const Eigen::Matrix2d a = by_turned.inverse() * by_plane;
    const Eigen::Matrix2d aat = a * a.transpose();
    const double trace = aat.trace(), apart = aat(0, 0) - aat(1, 1);
    const double gamma = std::sqrt(
        0.5 * (trace + std::sqrt(std::max(0.0, apart * apart + 4.0 * aat(0, 1) * aat(0, 1)))));
    if (!(gamma > 1e-12)) return 0;
    const Eigen::Matrix2d turned = a / gamma;
    const double b0 = std::sqrt(std::max(0.0, 1.0 - turned.col(0).squaredNorm()));
    const double b1 = std::copysign(std::sqrt(std::max(0.0, 1.0 - turned.col(1).squaredNorm())),
                                    -turned.col(0).dot(turned.col(1)));
    const double depth = 0.5 * size_.value() / gamma;
    int count = 0;
    for (const double sign : {1.0, -1.0}) {
      Eigen::Matrix3d rotation;
      rotation.col(0) << turned.col(0), sign * b0;
      rotation.col(1) << turned.col(1), sign * b1;
      rotation.col(2) = rotation.col(0).cross(rotation.col(1));
      rotation = Eigen::Quaterniond(to_ray * rotation).normalized().toRotationMatrix();
      if (!rotation.allFinite() || !(depth > 0.0) || !std::isfinite(depth)) continue;
      Transform<Camera, Marker>& start = (*starts)[count++];
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(start.rotation.m.data()) = rotation;
      start.translation_m = {p * depth, q * depth, depth};
    }
    return count;
  }

  std::optional<Refined> Refine(Transform<Camera, Marker> pose) const {
    Linear here, there;
    if (!Linearize(pose, &here)) return std::nullopt;
    double damping = kFirstDamping;
    for (int step = 0; step < kMaxSteps && damping < kMaxDamping; ++step) {
      Eigen::Matrix<double, 6, 6> damped = here.information;
      damped.diagonal() *= 1.0 + damping;
      const Vector6 scaled = -damped.ldlt().solve(here.gradient);
      if (!scaled.allFinite()) return std::nullopt;
      const Vector6 move = here.size.cwiseInverse().cwiseProduct(scaled);
      const Transform<Camera, Marker> moved = Perturbed(pose, move);
      const bool still = move.head<3>().norm() < kStill &&
                         move.tail<3>().norm() < kStill * Norm(pose.translation_m);
      if (!Linearize(moved, &there) || !(there.cost <= here.cost)) {
        if (still) break;
        damping = std::max(10.0 * damping, 1e-3);
        continue;
      }
      // A heavily damped step reduces the cost little anywhere, so it does not show convergence.
      const bool same =
          damping <= kLittleDamping && here.cost - there.cost <= kNoGain * (1.0 + here.cost);
      pose = moved;
      here = there;
      damping *= 0.1;
      if (still || same) break;
    }
    Refined refined;
    refined.solution = {pose, ReprojectionRms(pose), here.cost};
    refined.cost = here.cost;
    const Eigen::Matrix<double, 6, 6> inverse =
        here.information.ldlt().solve(Eigen::Matrix<double, 6, 6>::Identity());
    const Eigen::Matrix<double, 6, 6> covariance =
        here.size.cwiseInverse().asDiagonal() * inverse * here.size.cwiseInverse().asDiagonal();
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(refined.covariance.data()) =
        0.5 * (covariance + covariance.transpose());
    return refined;
  }

 private:
  /// The whitened reprojection errors at a pose, to first order in its left perturbation (w, d):
  /// camera_from_marker' = (Exp(w) R, t + d).
  struct Linear {
    double cost = 0.0;  ///< Squared length.
    Vector6 size;  ///< Norms of the derivatives, because metres and radians have different scales,
                   ///< …
    Eigen::Matrix<double, 6, 6> information;  ///< … here normalised to 1.
    Vector6 gradient;
  };
  /// Returns false if a corner lies behind the camera, or the equations are singular.
  bool Linearize(const Transform<Camera, Marker>& pose, Linear* linear) const {
    using Jet = ceres::Jet<double, 2>;
    Vector8 errors;
    Eigen::Matrix<double, 8, 6> jacobian;
    for (int i = 0; i < 4; ++i) {
      const Vec3 rotated = pose.rotation * corners_in_marker_[i];
      const Vec3 at = rotated + pose.translation_m;
      if (!(at.z > 1e-9)) return false;
      const double per_z = 1.0 / at.z;
      Jet u, v;
      DistortNormalized(camera_, Jet(at.x * per_z, 0), Jet(at.y * per_z, 1), &u, &v);
      const Vec2 error{camera_.fx * u.a + camera_.cx - corners_px_[i].x,
                       camera_.fy * v.a + camera_.cy - corners_px_[i].y};
      const auto row = [&](int index, double focal, const Jet& bent, double value) {
        // Derivatives by the point in space: its ray is (x/z, y/z).
        const double x = focal * bent.v[0] * per_z, y = focal * bent.v[1] * per_z;
        const double z = -(x * at.x + y * at.y) * per_z;
        errors[index] = value;
        jacobian.row(index) << rotated.y * z - rotated.z * y, rotated.z * x - rotated.x * z,
            rotated.x * y - rotated.y * x, x, y, z;
      };
      row(2 * i, camera_.fx, u, error.x);
      row(2 * i + 1, camera_.fy, v, error.y);
    }
    // For these small matrices lazy products are faster than Eigen's products for large ones.
    errors = whitening_.lazyProduct(errors).eval();
    jacobian = whitening_.lazyProduct(jacobian).eval();
    linear->cost = errors.squaredNorm();
    linear->size = jacobian.colwise().norm();
    if (!std::isfinite(linear->cost) || !(linear->size.minCoeff() > 0.0)) return false;
    jacobian = jacobian * linear->size.cwiseInverse().asDiagonal();
    linear->information.noalias() = jacobian.transpose().lazyProduct(jacobian);
    linear->gradient.noalias() = jacobian.transpose().lazyProduct(errors);
    return true;
  }

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
  const Matrix8& whitening_;  ///< Lower-triangular inverse of the covariance's Cholesky factor.
  const Metres size_;
  const std::array<Vec3, 4> corners_in_marker_;
};

/// Likelihood ratio of two poses with these squared errors, under the multivariate t distribution.
/// Lange, Little & Taylor 1989, "Robust statistical modeling using the t distribution", Eq. (1).
double LikelihoodRatio(double chi2, double other_chi2) {
  return std::pow((kTailFreedom + other_chi2) / (kTailFreedom + chi2),
                  0.5 * (kTailFreedom + kMisfitFreedom));
}

/// If only the corners selected the pose, the other may be the true one. With the probability given
/// by the reprojection errors, its squared distance is part of the best one's variance (second
/// moment of a mixture of two).
void WidenByAlternative(const Refined& best, const Refined& other, PoseEstimate* estimate) {
  const auto rotation = [](const Refined& refined) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
        refined.solution.camera_from_marker.rotation.m.data());
  };
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(rotation(other) * rotation(best).transpose()));
  const Vec3 shift = other.solution.camera_from_marker.translation_m -
                     best.solution.camera_from_marker.translation_m;
  Vector6 apart;
  apart << turn.angle() * turn.axis(), shift.x, shift.y, shift.z;
  const double ratio = LikelihoodRatio(other.cost, best.cost);
  const double share = ratio / (1.0 + ratio);
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(estimate->covariance.data()) +=
      share * apart * apart.transpose();
}

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
  std::array<Transform<Camera, Marker>, 2> starts;
  std::array<Refined, 2> solutions;
  int count = 0;
  for (int i = 0, all = problem.Starts(&starts); i < all; ++i) {
    if (const std::optional<Refined> refined = problem.Refine(starts[i])) {
      solutions[count++] = *refined;
    }
  }
  if (count == 0) return std::nullopt;
  if (count > 1 && solutions[1].cost < solutions[0].cost) std::swap(solutions[0], solutions[1]);
  if (likely_rotation != nullptr && count > 1 &&
      solutions[1].cost - solutions[0].cost < kUndecided) {
    const auto angle = [&](const Refined& refined) {
      return AngleBetween(refined.solution.camera_from_marker.rotation, *likely_rotation);
    };
    if (angle(solutions[1]) < angle(solutions[0])) std::swap(solutions[0], solutions[1]);
  }
  PoseEstimate estimate;
  estimate.best = solutions[0].solution;
  estimate.covariance = solutions[0].covariance;
  if (count > 1 &&
      AngleBetween(solutions[0].solution.camera_from_marker.rotation,
                   solutions[1].solution.camera_from_marker.rotation) > kSameRotation_rad) {
    estimate.alternative = solutions[1].solution;
    estimate.ambiguity_ratio =
        std::min(1.0, LikelihoodRatio(estimate.alternative->chi2, estimate.best.chi2));
    if (likely_rotation == nullptr) WidenByAlternative(solutions[0], solutions[1], &estimate);
  }
  return estimate;
}

}  // namespace pleinair::tracker
