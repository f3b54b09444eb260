#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "compositor/light_solver.h"
#include "compositor/sun_footprint.h"

namespace pleinair::compositor {

/// Sorts a phantom's triangles by what virtual objects may change of their light: what they leave
/// alone needs no shading, and what is in its own shade anyway no look into shadow maps.
class ChangingTriangles {
 public:
  /// In the order of the sorted triangles.
  enum Change {
    kSun,        ///< The sun's light may change.
    kSunlitSky,  ///< Only the sky's, and the sun shines on it unless something hides it.
    kOpenSky,    ///< Only the sky's, and no phantom keeps the sun from any of it.
    kSky,        ///< Only the sky's, and no sun shines on it.
    kNothing,
    kChanges
  };

  explicit ChangingTriangles(const LitMesh& phantom);
  /// Another light on the same triangles: counts from the next Sort() on.
  void SetLight(const LitMesh& phantom);

  /// Sorts; one past the last index of each kind is in ends(). `objects`: of the same window.
  void Sort(const SunWindow& window, const SunFootprint& objects = {});
  std::span<const std::uint32_t> indices() const { return indices_; }
  const std::array<int, kChanges>& ends() const { return ends_; }

  /// A change of light, relative, that no 8-bit picture shows: a quarter of a code at white.
  static constexpr float kNoticeable = 0.002F;

 private:
  Change ChangeOf(const SunWindow& window, const SunFootprint& objects,
                  std::size_t first_index) const;

  std::vector<glm::vec3> positions_, normals_;
  std::vector<bool> sky_changes_;         // By vertex.
  std::vector<SunReach> sun_reach_;       // By triangle as the mesh has them, or empty.
  glm::vec3 reached_to_sun_{0.0F};        // Where the sun stood for that.
  std::vector<std::uint32_t> triangles_;  // The mesh's indices.
  std::vector<std::uint32_t> indices_;    // Sorted.
  std::array<std::vector<std::uint32_t>, kChanges> kinds_;
  std::array<int, kChanges> ends_{};
};

}  // namespace pleinair::compositor
