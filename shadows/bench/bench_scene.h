#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "shadows/light_window.h"

namespace pleinair::shadows {

/// Triangles of a scene to measure shadows in; marker coordinates (z up), metres.
struct BenchMesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;  ///< Three a triangle.
  glm::vec3 albedo{0.5F};              ///< Linear; for pictures.
  bool leaves = false;                 ///< A crown: thin blockers and receivers amid gaps.
};

/// A straight edge above the ground z = 0 whose penumbra has a closed form. It runs along x.
struct StraightEdge {
  glm::dvec3 middle{0.0};   ///< Of the edge.
  double length = 0.0;      ///< Along x.
  double lit_side_y = 1.0;  ///< ±1: on which side of its shadow, along y, the sun shines.
};

/// A foot where a vertical wall, along x, meets the ground on its shadow side.
struct ContactEdge {
  glm::dvec3 middle{0.0};
  double length = 0.0;
  double away_y = 1.0;  ///< ±1: along y, away from the wall.
};

struct BenchScene {
  std::string name;   ///< In files: "pole_and_box".
  std::string title;  ///< For people.
  std::vector<BenchMesh> meshes;
  glm::dvec3 to_sun{0.0, 0.0, 1.0};  ///< Unit.
  View view;  ///< Its depths bound what can be seen; the renderer tightens them.
  std::vector<StraightEdge> edges = {};
  std::vector<ContactEdge> contacts = {};
};

/// A camera at `eye` that looks at `target`, x level, with `fov` radians across.
View LookAt(const glm::dvec3& eye, const glm::dvec3& target, double fov_rad, double aspect);

/// Boards, a box and a pole over level ground: every penumbra of a straight edge and every contact
/// has a closed form. Boards hang 0.25, 0.5, 1 and 2 m up.
BenchScene PoleAndBoxScene(double aspect);
/// Trees of thin leaves, a body and the wall behind it (the situation of Kolivand & Sunar 2014,
/// Figures 6, 8, 13 and 14).
BenchScene TreesScene(double aspect);
/// A field of half a kilometre with objects 1 m, 10 m and 200 m away.
BenchScene WideFieldScene(double aspect);

}  // namespace pleinair::shadows
