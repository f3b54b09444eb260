#include "tracker/calibration/lens_uncertainty.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tracker/calibration/lens_residual.h"

namespace pleinair::tracker {
namespace {

using Lens = Eigen::MatrixXd;
using PoseBlock = Eigen::Matrix<double, kPoseNumbers, kPoseNumbers>;
template <int kColumns>
using Rows = Eigen::Map<const Eigen::Matrix<double, 2, kColumns, Eigen::RowMajor>>;

}  // namespace

LensUncertainty Uncertainty(const LensFit& fit, const std::vector<PlaneView>& views,
                            double min_noise_px) {
  const int free = 4 + CoefficientsOf(fit.kind);
  Lens information = Lens::Zero(free, free);
  double squares = 0.0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const PoseNumbers pose = NumbersOf(fit.camera_from_board[i]);
    PixelDerivatives derivatives;
    Eigen::MatrixXd cross = Eigen::MatrixXd::Zero(free, kPoseNumbers);
    PoseBlock pose_block = PoseBlock::Zero();
    for (const Vec2 on_board : views[i].on_board_m) {
      ProjectBoardPoint(fit.camera, pose.data(), on_board, &derivatives);
      const auto by_lens = Rows<kLensNumbers>(derivatives.by_lens.data()).leftCols(free);
      const Rows<kPoseNumbers> by_pose(derivatives.by_pose.data());
      information += by_lens.transpose() * by_lens;
      cross += by_lens.transpose() * by_pose;
      pose_block += by_pose.transpose() * by_pose;
    }
    information -= cross * pose_block.ldlt().solve(cross.transpose());
    for (const Vec2 each : Residuals(fit.camera, fit.camera_from_board[i], views[i])) {
      squares += each.x * each.x + each.y * each.y;
    }
    points += views[i].on_board_m.size();
  }
  LensUncertainty uncertainty;
  const double unknowns =
      free + static_cast<double>(kPoseNumbers) * static_cast<double>(views.size());
  const double left = std::max(1.0, 2.0 * static_cast<double>(points) - unknowns);
  uncertainty.noise_px = std::sqrt(squares / left);
  // Scaled to a unit diagonal: coefficients and focal lengths differ by many powers of ten.
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Lens scaled =
      scale.cwiseInverse().asDiagonal() * information * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Lens> eigen(scaled);
  constexpr double kSingular = 1e-13;
  uncertainty.determined = eigen.info() == Eigen::Success && eigen.eigenvalues()(0) > kSingular;
  if (!uncertainty.determined) return uncertainty;
  const Lens covariance = eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
                          eigen.eigenvectors().transpose();
  const double noise = std::max(uncertainty.noise_px, min_noise_px);
  uncertainty.assumed_px = noise;
  const auto deviation = [&](int i) { return noise * std::sqrt(covariance(i, i)) / scale(i); };
  uncertainty.fx = deviation(0);
  uncertainty.fy = deviation(1);
  uncertainty.cx = deviation(2);
  uncertainty.cy = deviation(3);
  for (int i = 4; i < free; ++i)
    uncertainty.distortion[static_cast<std::size_t>(i - 4)] = deviation(i);
  return uncertainty;
}

}  // namespace pleinair::tracker
