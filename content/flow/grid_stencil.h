#pragma once

// Internal: weights of the nodes along one axis.

#include <array>
#include <cstddef>

#include "content/flow/grid_axis.h"

namespace pleinair::content {

/// Four successive nodes from `first` on, with their weights. Absent ones have weight 0 and repeat
/// the nearest.
struct AxisStencil {
  std::array<int, 4> node{};
  std::array<double, 4> weight{};
};

/// Catmull-Rom weights of a place between nodes 1 and 2 of four at equal distances:
/// ½ (−t + 2t² − t³, 2 − 5t² + 3t³, t + 4t² − 3t³, −t² + t³).
inline std::array<double, 4> CatmullRomWeights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {0.5 * (-t + 2.0 * t2 - t3), 0.5 * (2.0 - 5.0 * t2 + 3.0 * t3),
          0.5 * (t + 4.0 * t2 - 3.0 * t3), 0.5 * (t3 - t2)};
}

/// A node beyond the border has the value of the parabola through the three next ones,
/// 3 p₀ − 3 p₁ + p₂, which exactly continues fields of second order. Two nodes: linear.
inline AxisStencil CatmullRomStencil(int index, double t, int count) {
  AxisStencil stencil;
  if (count == 1) {
    stencil.weight[1] = 1.0;
    return stencil;
  }
  std::array<double, 4> w = CatmullRomWeights(t);
  if (count == 2) {
    w = {0.0, 1.0 - t, t, 0.0};
  } else {
    if (index == 0) {
      w = {0.0, w[1] + 3.0 * w[0], w[2] - 3.0 * w[0], w[3] + w[0]};
    }
    if (index == count - 2) {
      w = {w[0] + w[3], w[1] - 3.0 * w[3], w[2] + 3.0 * w[3], 0.0};
    }
  }
  for (int n = 0; n < 4; ++n) {
    const int node = index - 1 + n;
    stencil.node[static_cast<std::size_t>(n)] = node < 0 ? 0 : (node >= count ? count - 1 : node);
  }
  stencil.weight = w;
  return stencil;
}

/// The same for unequal cells: Hermite's cubic with the slopes of parabolas through three nodes,
/// which are Catmull and Rom's for equal ones.
inline AxisStencil HermiteStencil(const GridAxis& axis, int index, double t) {
  const int count = axis.count();
  if (axis.uniform() || count < 3) return CatmullRomStencil(index, t, count);
  AxisStencil stencil;
  for (int n = 0; n < 4; ++n) {
    const int node = index - 1 + n;
    stencil.node[static_cast<std::size_t>(n)] = node < 0 ? 0 : (node >= count ? count - 1 : node);
  }
  const double t2 = t * t, t3 = t2 * t, h = axis.Step(index);
  const double slope1 = (t3 - 2.0 * t2 + t) * h, slope2 = (t3 - t2) * h;
  std::array<double, 4>& w = stencil.weight;
  w = {0.0, 2.0 * t3 - 3.0 * t2 + 1.0, 3.0 * t2 - 2.0 * t3, 0.0};
  // Slope of the parabola through p(a), p(a + 1), p(a + 2), at one of them.
  const auto add_slope = [&](double factor, int a, int at) {
    const double d0 = axis.Step(a), d1 = axis.Step(a + 1);
    const double x = at == 0 ? -d0 : (at == 1 ? 0.0 : d1);  // From the node in the middle.
    const std::size_t first = static_cast<std::size_t>(a - (index - 1));
    w[first] += factor * (2.0 * x - d1) / (d0 * (d0 + d1));
    w[first + 1] += factor * (d1 - d0 - 2.0 * x) / (d0 * d1);
    w[first + 2] += factor * (2.0 * x + d0) / (d1 * (d0 + d1));
  };
  const bool has_before = index > 0, has_after = index + 2 < count;
  if (has_before) {
    add_slope(slope1, index - 1, 1);
  } else {
    add_slope(slope1, index, 0);
  }
  if (has_after) {
    add_slope(slope2, index, 1);
  } else {
    add_slope(slope2, index - 1, 2);
  }
  return stencil;
}

}  // namespace pleinair::content
