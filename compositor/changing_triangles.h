#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "compositor/light_solver.h"

namespace pleinair::compositor {

/// Where virtual objects may change the sun's light: a square across its rays, as
/// shadows::ShadowSliceUniforms has it.
struct SunWindow {
  glm::vec4 u_from_marker{0.0F}, v_from_marker{0.0F};
  float side = 0.0F;       ///< Of the square, from 0 on.
  glm::vec3 to_sun{0.0F};  ///< Unit; zero without a sun.
  bool operator==(const SunWindow&) const = default;

  /// For maps that do not say where they end.
  static SunWindow Everywhere(const glm::vec3& to_sun) {
    const glm::vec4 inside(0.0F, 0.0F, 0.0F, 1.0F);
    return {inside, inside, 2.0F, to_sun};
  }
};

/// Sorts a phantom's triangles by what virtual objects may change of their light: what they leave
/// alone needs no shading, and what is in its own shade anyway no look into shadow maps.
class ChangingTriangles {
 public:
  /// In the order of the sorted triangles.
  enum Change {
    kSun,        ///< The sun's light may change.
    kSunlitSky,  ///< Only the sky's, and the sun shines on it unless something hides it.
    kSky,        ///< Only the sky's, and no sun shines on it.
    kNothing,
    kChanges
  };

  explicit ChangingTriangles(const LitMesh& phantom);

  /// Sorts; one past the last index of each kind is in ends().
  void Sort(const SunWindow& window);
  std::span<const std::uint32_t> indices() const { return indices_; }
  const std::array<int, kChanges>& ends() const { return ends_; }

  /// A change of light, relative, that no 8-bit picture shows: half a code at white.
  static constexpr float kNoticeable = 0.002F;

 private:
  Change ChangeOf(const SunWindow& window, std::size_t first_index) const;

  std::vector<glm::vec3> positions_, normals_;
  std::vector<bool> sky_changes_;  // By vertex.
  std::vector<std::uint32_t> indices_;
  std::array<std::vector<std::uint32_t>, kChanges> kinds_;
  std::array<int, kChanges> ends_{};
};

}  // namespace pleinair::compositor
