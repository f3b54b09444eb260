#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "base/vector.h"
#include "content/draping/plan_tree.h"

namespace pleinair::content {

/// Distance in plan within which a point counts as lying on a line, metres: rounding of models,
/// whose coordinates have single precision.
inline constexpr double kOnLine_m = 1e-6;

/// Triangles that map data is draped on, in the tangent frame of the place, metres.
struct SurfaceMesh {
  std::vector<Point<World>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// For each triangle the number of the surface that it belongs to, such as a phantom.
  std::vector<std::uint32_t> surfaces;
};

/// Which of several surfaces above one another, such as bridge and ground.
enum class SurfaceChoice {
  kTop,     ///< The highest.
  kLowest,  ///< The lowest.
  kNamed,   ///< The highest of one surface alone.
};

struct SurfaceRule {
  SurfaceChoice choice = SurfaceChoice::kTop;
  std::uint32_t surface = 0;  ///< With kNamed.

  bool Allows(std::uint32_t number) const {
    return choice != SurfaceChoice::kNamed || number == surface;
  }
  /// True if height `a` is chosen before `b`.
  bool Prefers(double a, double b) const {
    return choice == SurfaceChoice::kLowest ? a < b : a > b;
  }
};

/// Finds the triangles under a point or a line. Which way they face does not matter. Safe for
/// several threads at once.
class SurfaceIndex {
 public:
  /// Errors (input): a vertex is not finite or farther than 10⁷ m; a triangle has a vertex that
  /// does not exist; the number of surfaces is not that of triangles.
  static Result<SurfaceIndex> Create(SurfaceMesh mesh);

  /// The height of the surface at a place, metres. Edges and corners belong to the triangles.
  /// Vertical faces have no height. Unset: no surface lies there.
  std::optional<double> HeightAt(Vec2 east_north, const SurfaceRule& rule) const;

  /// Collects the numbers of triangles that may be met between a and b, in rising order.
  void TrianglesAlong(Vec2 a, Vec2 b, std::vector<std::uint32_t>* triangles) const;

  /// Calls `visit(number)` for the same triangles in another order, which is always the same.
  template <typename Visit>
  void VisitAlong(Vec2 a, Vec2 b, const Visit& visit) const {
    tree_.VisitAlong(a, b, kOnLine_m, visit);
  }

  const SurfaceMesh& mesh() const { return mesh_; }
  std::array<Vec3, 3> Corners(std::uint32_t triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return {mesh_.vertices[a].xyz, mesh_.vertices[b].xyz, mesh_.vertices[c].xyz};
  }
  /// Faces within 10⁻⁶ rad of the vertical: seen from above they are lines.
  bool IsVertical(std::uint32_t triangle) const { return vertical_[triangle]; }

 private:
  SurfaceIndex(SurfaceMesh mesh, PlanTree tree, std::vector<bool> vertical);

  SurfaceMesh mesh_;
  PlanTree tree_;
  std::vector<bool> vertical_;
};

}  // namespace pleinair::content
