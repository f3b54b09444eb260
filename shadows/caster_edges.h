#pragma once

#include <glm/glm.hpp>

namespace pleinair::shadows {

/// An edge of a caster at which its shadow may end: a border, or a convex edge between two
/// triangles. Coordinates of the caster, metres.
struct CasterEdge {
  glm::vec3 a{0.0F}, b{0.0F};  ///< Its ends.
  glm::vec3 normal{0.0F};      ///< That of one triangle, any length.
  glm::vec3 other{0.0F};       ///< That of the other one; zero: a border.

  /// Whether the caster's outline, as seen from `to_sun`, has this edge.
  bool IsOutline(const glm::dvec3& to_sun) const {
    return glm::dot(glm::dvec3(normal), to_sun) * glm::dot(glm::dvec3(other), to_sun) <= 0.0;
  }
};

}  // namespace pleinair::shadows
