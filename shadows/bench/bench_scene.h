#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "shadows/light_window.h"

namespace pleinair::shadows {

/// Triangle mesh of a benchmark scene; marker coordinates (z up), metres.
struct BenchMesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;  ///< Three per triangle.
  glm::vec3 albedo{0.5F};              ///< Linear; for images.
  bool leaves = false;                 ///< A crown: thin casters and receivers with gaps between.
};

/// A straight edge above the ground z = 0 whose penumbra has a closed form. Parallel to x.
struct StraightEdge {
  glm::dvec3 middle{0.0};   ///< Centre of the edge.
  double length = 0.0;      ///< Along x.
  double lit_side_y = 1.0;  ///< ±1: side of its shadow, along y, that is lit.
};

/// Foot of a vertical wall, parallel to x, where it meets the ground on its shadow side.
struct ContactEdge {
  glm::dvec3 middle{0.0};
  double length = 0.0;
  double away_y = 1.0;  ///< ±1: direction along y away from the wall.
};

struct BenchScene {
  std::string name;   ///< Name in files: "pole_and_box".
  std::string title;  ///< Title in reports.
  std::vector<BenchMesh> meshes;
  glm::dvec3 to_sun{0.0, 0.0, 1.0};  ///< Unit.
  View view;  ///< Its depths bound the visible range; the renderer tightens them.
  std::vector<StraightEdge> edges = {};
  std::vector<ContactEdge> contacts = {};
};

/// A camera at `eye` that looks at `target`, x axis level, horizontal field of view `fov`.
View LookAt(const glm::dvec3& eye, const glm::dvec3& target, double fov_rad, double aspect);

/// Boards, a box and a pole over level ground. Every penumbra of a straight edge and every contact
/// has a closed form. The boards are 0.25, 0.5, 1 and 2 m above the ground.
BenchScene PoleAndBoxScene(double aspect);
/// Trees of thin leaves, an animal's body and a wall behind it (as in Kolivand & Sunar 2014,
/// Figures 6, 8, 13 and 14).
BenchScene TreesScene(double aspect);
/// A field of half a kilometre with objects at distances of 1 m, 10 m and 200 m.
BenchScene WideFieldScene(double aspect);

}  // namespace pleinair::shadows
