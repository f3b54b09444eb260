#include "tracker/pose/corner_covariance.h"

#include <Eigen/Dense>

namespace pleinair::tracker {

CornerCovariance CovarianceOfCorners(const std::array<FittedCorner, 4>& corners,
                                     const std::array<double, 64>& motion, double systematic_px) {
  using Square = Eigen::Matrix<double, 8, 8>;
  using RowMajor = Eigen::Matrix<double, 8, 8, Eigen::RowMajor>;
  Square corners_by_motion;
  for (int i = 0; i < 4; ++i) {
    const FittedCorner& corner = corners[i];
    const double u = corner.unit.x, v = corner.unit.y;
    const std::array<double, 8> flow_u{1, u, v, 0, 0, 0, -u * u, -u * v};
    const std::array<double, 8> flow_v{0, 0, 0, 1, u, v, -u * v, -v * v};
    for (int k = 0; k < 8; ++k) {
      corners_by_motion(2 * i, k) = corner.by_u.x * flow_u[k] + corner.by_v.x * flow_v[k];
      corners_by_motion(2 * i + 1, k) = corner.by_u.y * flow_u[k] + corner.by_v.y * flow_v[k];
    }
  }
  // Lazy products allocate no memory.
  const Square by_motion = corners_by_motion.lazyProduct(Eigen::Map<const RowMajor>(motion.data()));
  CornerCovariance covariance;
  Eigen::Map<RowMajor>(covariance.data()) = by_motion.lazyProduct(corners_by_motion.transpose()) +
                                            systematic_px * systematic_px * Square::Identity();
  return covariance;
}

}  // namespace pleinair::tracker
