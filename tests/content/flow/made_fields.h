#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "content/flow/grid_field.h"

namespace pleinair::content {

using FieldFunction = std::function<Vec3(const Vec3&, Seconds)>;

/// A field of doubles whose nodes have the values of a function.
inline std::shared_ptr<const GridField> MakeField(StructuredGrid grid, std::vector<Seconds> times,
                                                  const FieldFunction& function,
                                                  Interpolation interpolation) {
  const std::array<int, 3> n = grid.counts();
  std::vector<Vec3> nodes;
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) nodes.push_back(grid.Node(i, j, k));
    }
  }
  std::array<bool, 3> used{n[0] > 1, n[1] > 1, n[2] > 1};
  for (std::size_t a = 0; a < 3 && used[0] + used[1] + used[2] < 2; ++a) used[a] = true;
  const std::vector<Seconds> moments = times.empty() ? std::vector<Seconds>{0.0} : times;
  auto read = [nodes, used, moments, function](std::size_t time) -> Result<FieldSlice> {
    FieldSlice slice;
    for (const Vec3& node : nodes) {
      const Vec3 v = function(node, moments[time]);
      if (used[0]) slice.doubles.push_back(v.x);
      if (used[1]) slice.doubles.push_back(v.y);
      if (used[2]) slice.doubles.push_back(v.z);
    }
    return slice;
  };
  return GridField::Create(std::move(grid), std::move(times), std::move(read),
                           {.interpolation = interpolation})
      .value();
}

/// A square of `count` × `count` nodes from −half to half, in the plane z = 0.
inline StructuredGrid Square(int count, double half_m) {
  const GridAxis axis(-half_m, 2.0 * half_m / (count - 1), count);
  return {{axis, axis, GridAxis()}, {}};
}

inline std::shared_ptr<const GridField> MakeSteady(
    StructuredGrid grid, const std::function<Vec3(const Vec3&)>& function,
    Interpolation interpolation = Interpolation::kLinear) {
  return MakeField(
      std::move(grid), {}, [function](const Vec3& p, Seconds) { return function(p); },
      interpolation);
}

/// Turns around the z axis, one radian per second.
inline Vec3 SolidRotation(const Vec3& p) { return {-p.y, p.x, 0.0}; }

/// Rankine's vortex with a core of 0.2: within, one radian per second.
inline Vec3 Rankine(const Vec3& p) {
  constexpr double kCore = 0.2;
  const double r2 = p.x * p.x + p.y * p.y;
  const double turn = r2 < kCore * kCore ? 1.0 : kCore * kCore / r2;
  return {-p.y * turn, p.x * turn, 0.0};
}

/// Arnold, Beltrami and Childress' flow with A, B, C = √3, √2, 1.
inline Vec3 AbcFlow(const Vec3& p) {
  const double a = std::sqrt(3.0), b = std::sqrt(2.0), c = 1.0;
  return {a * std::sin(p.z) + c * std::cos(p.y), b * std::sin(p.x) + a * std::cos(p.z),
          c * std::sin(p.y) + b * std::cos(p.x)};
}

/// Runge and Kutta's method of order 4 with equal steps.
inline Vec3 FineRk4(const VectorField& field, Vec3 p, Seconds from_s, Seconds to_s, int steps) {
  const double h = (to_s - from_s) / steps;
  for (int i = 0; i < steps; ++i) {
    const Seconds t = from_s + i * h;
    const Vec3 k1 = field.At(p, t), k2 = field.At(p + k1 * (0.5 * h), t + 0.5 * h);
    const Vec3 k3 = field.At(p + k2 * (0.5 * h), t + 0.5 * h), k4 = field.At(p + k3 * h, t + h);
    p = p + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
  }
  return p;
}

}  // namespace pleinair::content
