#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "compositor/light/lit_mesh.h"

namespace pleinair::compositor {

/// Sorts a virtual object's triangles by whether the sun may shine on them: those that are turned
/// away from it, some half of a body, need no look into shadow maps.
class SunFacingTriangles {
 public:
  explicit SunFacingTriangles(const LitMesh& object);

  /// Sorts anew where the sun has moved by more than kMargin allows; returns whether it did.
  /// `to_sun`: unit, as the object stands in its mesh; zero without a sun, which none faces.
  bool Sort(const glm::vec3& to_sun);
  /// Counts all triangles as facing the sun until Sort(); returns whether it did not before.
  bool IncludeAll();
  /// Those that may face the sun first.
  std::span<const std::uint32_t> indices() const { return indices_; }
  int facing_end() const { return facing_end_; }

  /// A triangle is turned away where the cosines between sun and normals at its corners are below
  /// minus this: some degrees, which the sun may move before triangles are sorted again.
  static constexpr float kMargin = 0.05F;

 private:
  std::vector<glm::vec3> normals_;
  std::vector<std::uint32_t> indices_, turned_away_;
  std::optional<glm::vec3> sorted_for_;
  int facing_end_ = 0;
};

}  // namespace pleinair::compositor
