#include "session/trajectory/point_alignment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "session/trajectory/alignment_numbers.h"

namespace pleinair::session {
namespace {

/// Centred points, one a column.
struct CentredPoints {
  Eigen::Matrix3Xd offsets;
  Eigen::Vector3d mean;
};

CentredPoints Centred(Eigen::Matrix3Xd points) {
  const Eigen::Vector3d mean = points.rowwise().mean();
  points.colwise() -= mean;
  return {std::move(points), mean};
}

/// Whether the points lie on a line, or in one place.
bool AreCollinear(const Eigen::Matrix3Xd& offsets) {
  constexpr double kMinWidth = 0.02;  // Width of the pattern over its length.
  const Eigen::Vector3d sizes = offsets.jacobiSvd().singularValues();
  return !(sizes[0] > 0.0 && sizes[1] > kMinWidth * sizes[0]);
}

}  // namespace

Result<TrajectoryAlignment> AlignByPoints(const std::vector<PointPair>& pairs, bool is_metric,
                                          const std::string& file) {
  constexpr std::size_t kMinPairs = 3;
  if (pairs.size() < kMinPairs) {
    return InputError(file, "has fewer than three places", "give three that do not lie on a line");
  }
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::Matrix3Xd given(3, count), wanted(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    given.col(i) = EigenOf(pairs[static_cast<std::size_t>(i)].in_trajectory.xyz);
    wanted.col(i) = EigenOf(pairs[static_cast<std::size_t>(i)].in_scene.xyz);
  }
  const CentredPoints from = Centred(given), to = Centred(wanted);
  if (AreCollinear(from.offsets) || AreCollinear(to.offsets)) {
    return InputError(file, "has places that lie on a line or at one point",
                      "give three places that span a triangle");
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(to.offsets * from.offsets.transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1.0, 1.0, 1.0);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
  const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  TrajectoryAlignment alignment;
  TrajectorySimilarity& similarity = alignment.marker_from_trajectory;
  if (!is_metric) {
    similarity.scale = svd.singularValues().dot(signs) / from.offsets.squaredNorm();
  }
  similarity.rotation = MatOf(rotation);
  similarity.translation_m = VecOf(to.mean - similarity.scale * (rotation * from.mean));
  NormalEquations equations;
  double squares_m2 = 0.0;
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d arm = similarity.scale * (rotation * EigenOf(pair.in_trajectory.xyz));
    const Vec3 off = (similarity * pair.in_trajectory).xyz - pair.in_scene.xyz;
    Eigen::Matrix<double, 3, 7> by;
    by.leftCols<3>() = -CrossMatrix(arm);
    by.middleCols<3>(3).setIdentity();
    by.col(kScaleIndex) = arm;
    equations.matrix += by.transpose() * by;
    squares_m2 += Dot(off, off);
    alignment.residual_max = std::max(alignment.residual_max, Norm(off));
  }
  alignment.used = pairs.size();
  alignment.residual_rms = std::sqrt(squares_m2 / static_cast<double>(pairs.size()));
  constexpr double kMinNoise_m = 1e-3;
  const double freedom = 3.0 * static_cast<double>(pairs.size()) - (is_metric ? 6.0 : 7.0);
  const double variance = std::max(kMinNoise_m * kMinNoise_m, squares_m2 / freedom);
  if (const auto inverse = InverseOf(equations, is_metric)) {
    StoreCovariance(*inverse * variance, &alignment.covariance);
  }
  return alignment;
}

}  // namespace pleinair::session
