#pragma once

// Internal: between the .cc files of this folder; not installed.

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <optional>

#include "base/vector.h"

namespace pleinair::session {

using RowMajorRotation = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Seven = Eigen::Matrix<double, 7, 1>;
using SevenBySeven = Eigen::Matrix<double, 7, 7, Eigen::RowMajor>;

inline constexpr int kScaleIndex = 6;

inline Eigen::Vector3d EigenOf(Vec3 v) { return {v.x, v.y, v.z}; }
inline Vec3 VecOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Matrix3d EigenOf(const Mat3& m) {
  return Eigen::Map<const RowMajorRotation>(m.m.data());
}
inline Mat3 MatOf(const Eigen::Matrix3d& m) {
  Mat3 out;
  Eigen::Map<RowMajorRotation>(out.m.data()) = m;
  return out;
}
inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Normal equations of an alignment, in the order of SimilarityCovariance.
struct NormalEquations {
  SevenBySeven matrix = SevenBySeven::Zero();
  Seven gradient = Seven::Zero();
};

/// Removes a known scale from the equations: its step is 0.
inline void Hold(bool is_metric, NormalEquations* equations) {
  if (!is_metric) return;
  equations->matrix.row(kScaleIndex).setZero();
  equations->matrix.col(kScaleIndex).setZero();
  equations->matrix(kScaleIndex, kScaleIndex) = 1.0;
  equations->gradient[kScaleIndex] = 0.0;
}

/// Inverse of the normal equations; nothing if they are singular.
inline std::optional<SevenBySeven> InverseOf(NormalEquations equations, bool is_metric) {
  Hold(is_metric, &equations);
  // Scaled to a unit diagonal, so that units do not matter.
  const Seven diagonal = equations.matrix.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const SevenBySeven scaled = diagonal.asDiagonal() * equations.matrix * diagonal.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<SevenBySeven> solver(scaled);
  constexpr double kSingular = 1e-12;
  if (!(solver.eigenvalues()[0] > kSingular)) return std::nullopt;
  SevenBySeven inverse = diagonal.asDiagonal() * scaled.inverse() * diagonal.asDiagonal();
  if (is_metric) {
    inverse.row(kScaleIndex).setZero();
    inverse.col(kScaleIndex).setZero();
  }
  return inverse;
}

inline void StoreCovariance(const SevenBySeven& from, std::array<double, 49>* to) {
  Eigen::Map<SevenBySeven>(to->data()) = from;
}

}  // namespace pleinair::session
