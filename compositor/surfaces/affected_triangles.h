#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "compositor/composer_options.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/sun_footprint.h"
#include "compositor/surfaces/linear_shadow_ratio.h"

namespace pleinair::compositor {

/// Sorts a phantom's triangles by what virtual objects may change of their light: what they leave
/// alone needs no shading, and what has all of the sun or none of it anyway no look into shadow
/// maps.
class AffectedTriangles {
 public:
  /// In the order of the sorted triangles.
  enum Change {
    kSun,        ///< The sun's light may change.
    kSunlitSky,  ///< Only the sky's, and the sun shines on it unless something hides it.
    kLinearSky,  ///< Only the sky's, phantoms leave it all of the sun or none shines on it, and the
                 ///< ratio is linear along it.
    kNothing,
    kChanges
  };

  explicit AffectedTriangles(const LitMesh& phantom);
  /// Another light on the same triangles: counts from the next Sort() on.
  void SetLight(const LitMesh& phantom);

  /// Sorts; one past the last index of each kind is in ends(). `objects`: of the same window.
  /// `sun_normal_lux`: linear Rec.709, for linear_ratios(). Without a reduction, triangles are of
  /// the kind that needs more shading.
  void Sort(const SunWindow& window, const SunFootprint& objects, const glm::vec3& sun_normal_lux,
            const DrawReductions& reductions = {});
  std::span<const std::uint32_t> indices() const { return indices_; }
  const std::array<int, kChanges>& ends() const { return ends_; }
  /// What objects change of the kLinearSky triangles, in their order.
  std::span<const LinearShadowRatio> linear_ratios() const { return linear_ratios_; }
  /// The most of any place on them, of how far from 1 the ratio is, times the metres to the eye:
  /// what the air before it counts by.
  float MaxLinearChangeFarFrom(const glm::vec3& eye_m) const;

  /// A change of light, relative, that no 8-bit picture shows: a quarter of a code at white.
  static constexpr float kNoticeable = 0.002F;

 private:
  struct Sorted {
    Change change;
    bool in_sun;  // Of kLinearSky: all of the sun, not none.
  };
  /// By vertex: the light besides the sun's own, with the virtual objects and without.
  struct AmbientLight {
    std::vector<glm::vec3> with, without;
    std::vector<bool> changes;  // Whether the two differ.
  };
  struct SunOnTriangles {
    std::vector<SunVisibility> by_triangle;  // As the mesh has them, or empty.
    glm::vec3 to_sun{0.0F};                  // Where the sun stood for that.
  };
  Sorted ChangeOf(const SunWindow& window, const SunFootprint& objects,
                  const DrawReductions& reductions, std::size_t first_index) const;
  /// Nothing where the ratio is not linear along the triangle. `sun_normal_lux`: as far as it
  /// reaches.
  std::optional<LinearShadowRatio> LinearRatioOf(std::size_t first_index, const glm::vec3& to_sun,
                                                 const glm::vec3& sun_normal_lux) const;

  std::vector<glm::vec3> positions_, normals_;
  AmbientLight ambient_;
  SunOnTriangles sun_visibility_;
  std::vector<std::uint32_t> triangles_;  // The mesh's indices.
  std::vector<std::uint32_t> indices_;    // Sorted.
  std::array<std::vector<std::uint32_t>, kChanges> kinds_;
  std::vector<LinearShadowRatio> linear_ratios_;
  std::vector<std::array<std::uint32_t, 3>> linear_corners_;  // Their vertices.
  std::array<int, kChanges> ends_{};
};

}  // namespace pleinair::compositor
