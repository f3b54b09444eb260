#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace pleinair::compositor {

/// Weighted linear least squares in N unknowns by normal equations. Regressors should be of similar
/// size.
template <std::size_t N>
class WeightedFit {
 public:
  using Vector = std::array<double, N>;

  struct Solution {
    Vector value{};
    std::array<Vector, N> covariance{};  ///< For weights that are inverse variances.
  };

  void Add(const Vector& regressors, double value, double weight) {
    for (std::size_t i = 0; i < N; ++i) {
      right_[i] += weight * regressors[i] * value;
      for (std::size_t j = 0; j < N; ++j) left_[i][j] += weight * regressors[i] * regressors[j];
    }
  }

  /// Nothing where the regressors do not determine the unknowns.
  std::optional<Solution> Solve() const {
    constexpr double kSingular = 1e-10;
    std::array<Vector, N> left = left_, inverse{};
    for (std::size_t i = 0; i < N; ++i) inverse[i][i] = 1.0;
    for (std::size_t column = 0; column < N; ++column) {
      std::size_t pivot = column;
      for (std::size_t row = column; row < N; ++row) {
        if (std::fabs(left[row][column]) > std::fabs(left[pivot][column])) pivot = row;
      }
      // Against the diagonal before elimination, so that scales do not matter.
      if (!(std::fabs(left[pivot][column]) > kSingular * std::fabs(left_[column][column]))) {
        return std::nullopt;
      }
      std::swap(left[pivot], left[column]);
      std::swap(inverse[pivot], inverse[column]);
      const double scale = 1.0 / left[column][column];
      for (std::size_t j = 0; j < N; ++j) {
        left[column][j] *= scale;
        inverse[column][j] *= scale;
      }
      for (std::size_t row = 0; row < N; ++row) {
        if (row == column) continue;
        const double factor = left[row][column];
        for (std::size_t j = 0; j < N; ++j) {
          left[row][j] -= factor * left[column][j];
          inverse[row][j] -= factor * inverse[column][j];
        }
      }
    }
    Solution solution;
    solution.covariance = inverse;
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) solution.value[i] += inverse[i][j] * right_[j];
    }
    return solution;
  }

 private:
  std::array<Vector, N> left_{};
  Vector right_{};
};

}  // namespace pleinair::compositor
