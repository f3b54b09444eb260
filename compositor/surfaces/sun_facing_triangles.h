#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "compositor/light/lit_mesh.h"

namespace pleinair::compositor {

/// Sun-facing triangle culling: sorts a virtual object's triangles by whether the sun may shine on
/// them. Those that face away, about half of a body, need no shadow lookup.
class SunFacingTriangles {
 public:
  explicit SunFacingTriangles(const LitMesh& object);

  /// Turns the triangles.
  void SetNormals(const LitMesh& object);
  /// Sorts again if the sun has moved and normals have turned by more than kMargin allows. Returns
  /// whether it sorted.
  /// `to_sun`: unit, in the frame of the object's mesh; zero without a sun, which no triangle
  /// faces.
  bool Sort(const glm::vec3& to_sun);
  /// Counts all triangles as sun-facing until Sort(). Returns whether this changed anything.
  bool IncludeAll();
  /// The triangles that may face the sun come first.
  std::span<const std::uint32_t> indices() const { return indices_; }
  /// Normals of the vertices, unit.
  std::span<const glm::vec3> normals() const { return normals_; }
  int facing_end() const { return ends_[0]; }
  /// One past the last index of the triangles that may face the sun, and of all.
  std::span<const int> ends() const { return ends_; }

  /// A triangle faces away if the cosine between sun and normal is below −kMargin at all corners.
  /// Sun and normals together may move by some degrees before triangles are sorted again.
  static constexpr float kMargin = 0.05F;

 private:
  bool is_translucent_ = false;  // The sun shines on the other side too, and through.
  std::vector<glm::vec3> normals_, sorted_normals_;  // The latter: when they were last sorted.
  std::vector<std::uint32_t> indices_, turned_away_;
  std::vector<std::uint8_t> is_away_;  // By triangle, while it sorts.
  /// Max. distance of a normal from that of the last Sort().
  float NormalsTurned() const;

  bool has_turned_ = false;
  std::optional<glm::vec3> sorted_for_;
  std::array<int, 2> ends_{};
};

}  // namespace pleinair::compositor
