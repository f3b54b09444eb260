#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "content/draping/drape_lines.h"
#include "content/draping/surface_index.h"

namespace pleinair::tests {

using content::SurfaceMesh;

/// Adds triangles of one surface.
class MeshMaker {
 public:
  explicit MeshMaker(std::uint32_t surface = 0) : surface_(surface) {}

  std::uint32_t Vertex(Vec3 at) {
    mesh_.vertices.push_back({at});
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }
  void Triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.push_back({a, b, c});
    mesh_.surfaces.push_back(surface_);
  }
  void Quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const std::uint32_t first = Vertex(a);
    Vertex(b), Vertex(c), Vertex(d);
    Triangle(first, first + 1, first + 2);
    Triangle(first, first + 2, first + 3);
  }
  /// A grid of n by n squares over -half…half.
  void Field(int n, double half_m, const std::function<double(double, double)>& height) {
    const auto base = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto at = [&](int i) { return -half_m + 2.0 * half_m * i / n; };
    for (int row = 0; row <= n; ++row) {
      for (int column = 0; column <= n; ++column) {
        Vertex({at(column), at(row), height(at(column), at(row))});
      }
    }
    const auto number = [&](int column, int row) {
      return base + static_cast<std::uint32_t>(row * (n + 1) + column);
    };
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) {
        // Alternating diagonals.
        const std::uint32_t a = number(column, row), b = number(column + 1, row);
        const std::uint32_t c = number(column + 1, row + 1), d = number(column, row + 1);
        if ((row + column) % 2 == 0) {
          Triangle(a, b, c), Triangle(a, c, d);
        } else {
          Triangle(a, b, d), Triangle(b, c, d);
        }
      }
    }
  }
  void Box(Vec3 from, Vec3 to) {
    const auto corner = [&](bool x, bool y, bool z) {
      return Vec3{x ? to.x : from.x, y ? to.y : from.y, z ? to.z : from.z};
    };
    Quad(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
    Quad(corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0));
    Quad(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
    Quad(corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1));
    Quad(corner(1, 1, 0), corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1));
    Quad(corner(0, 1, 0), corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1));
  }
  void OfSurface(std::uint32_t surface) { surface_ = surface; }
  SurfaceMesh Take() { return std::move(mesh_); }

 private:
  SurfaceMesh mesh_;
  std::uint32_t surface_ = 0;
};

/// The height at a place by trying all triangles, by other formulae than those of the index: the
/// plane through the corners. `margin` shrinks (< 0) or grows the triangles in shares.
inline std::optional<double> TriedHeight(const SurfaceMesh& mesh, Vec2 at,
                                         const content::SurfaceRule& rule, double margin = 1e-12) {
  std::optional<double> chosen;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!rule.Allows(mesh.surfaces[i])) continue;
    const Vec3 a = mesh.vertices[mesh.triangles[i][0]].xyz;
    const Vec3 u = mesh.vertices[mesh.triangles[i][1]].xyz - a;
    const Vec3 v = mesh.vertices[mesh.triangles[i][2]].xyz - a;
    const double area = u.x * v.y - u.y * v.x;
    if (std::fabs(area) < 1e-9) continue;
    const double px = at.x - a.x, py = at.y - a.y;
    const double s = (px * v.y - py * v.x) / area, t = (u.x * py - u.y * px) / area;
    if (s < -margin || t < -margin || s + t > 1.0 + margin) continue;
    const double height = a.z + s * u.z + t * v.z;
    if (!chosen || rule.Prefers(height, *chosen)) chosen = height;
  }
  return chosen;
}

inline content::LineToDrape LineOf(std::vector<Vec3> points,
                                   content::PartKind kind = content::PartKind::kLine,
                                   std::uint32_t feature = 0) {
  content::LineToDrape line;
  line.kind = kind;
  line.feature = feature;
  for (const Vec3& point : points) line.points.push_back({point});
  return line;
}

inline content::SurfaceIndex IndexOf(SurfaceMesh mesh) {
  auto index = content::SurfaceIndex::Create(std::move(mesh));
  EXPECT_TRUE(index);
  return *std::move(index);
}

/// A field of hills on a slope, metres.
inline double Hills(double x, double y) {
  return 3.0 * std::sin(0.21 * x) * std::cos(0.17 * y) + 0.08 * x - 0.05 * y;
}

inline content::LineToDrape RandomLine(std::mt19937* random, double half_m, int vertices) {
  std::uniform_real_distribution<double> place(-half_m, half_m);
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(vertices));
  for (int i = 0; i < vertices; ++i) points.push_back({place(*random), place(*random), 0.0});
  return LineOf(points);
}

}  // namespace pleinair::tests
