#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "compositor/composer_options.h"
#include "compositor/light/light_mix.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/sun_footprint.h"
#include "compositor/surfaces/linear_shadow_ratio.h"

namespace pleinair::compositor {

/// Classifies a phantom's triangles as shadow receivers, by how virtual objects may change their
/// light. Unaffected triangles need no shading. Triangles in full sun or full shadow need no shadow
/// maps.
class AffectedTriangles {
 public:
  /// Kinds of change, in the order of the sorted triangles.
  enum Change {
    kSun,        ///< Direct sunlight may change.
    kSunlitSky,  ///< Only skylight changes; the sun lights it unless phantoms occlude the sun.
    kLinearSky,  ///< Only skylight changes; the sun lights all of it or none, and the ratio is
                 ///< linear along it.
    kNothing,
    kChanges
  };

  explicit AffectedTriangles(const LitMesh& phantom);
  /// Sets new light for the same triangles, valid from the next Sort().
  void SetLight(const LitMesh& phantom, const LightMix& mix = {});

  /// Sorts the triangles; ends() then has one past the last index of each kind. `objects` belongs
  /// to the same window. `sun_normal_lux`: linear Rec.709, for linear_ratios(). Without a
  /// reduction, triangles are of the kind that needs more shading.
  void Sort(const SunWindow& window, const SunFootprint& objects, const glm::vec3& sun_normal_lux,
            const DrawReductions& reductions = {});
  std::span<const std::uint32_t> indices() const { return indices_; }
  /// Vertex positions, marker coordinates, metres.
  std::span<const glm::vec3> positions() const { return positions_; }
  std::span<const glm::vec3> normals() const { return normals_; }
  const std::array<int, kChanges>& ends() const { return ends_; }
  /// The shadow ratios of the kLinearSky triangles, in their order.
  std::span<const LinearShadowRatio> linear_ratios() const { return linear_ratios_; }
  /// Max. of |1 − ratio| times the distance to the eye in metres, over the kLinearSky triangles.
  /// The fog scales it to the max. effect of aerial perspective on the ratio.
  float MaxLinearChangeFarFrom(const glm::vec3& eye_m) const;

  /// Relative change of light that is invisible in 8 bits: a quarter of a pixel value at white.
  static constexpr float kNoticeable = 0.002F;

 private:
  struct Sorted {
    Change change;
    bool in_sun;  // For kLinearSky: full sun instead of none.
  };
  /// Irradiance at the vertices without direct sunlight, with and without the virtual objects.
  struct AmbientLight {
    std::vector<glm::vec3> with, without;
    std::vector<bool> changes;  // Whether the two differ.
  };
  struct SunOnTriangles {
    std::vector<SunVisibility> by_triangle;  // The mesh's entries, or empty.
    glm::vec3 to_sun{0.0F};                  // Sun direction of these entries.
  };
  Sorted ChangeOf(const SunWindow& window, const SunFootprint& objects,
                  const DrawReductions& reductions, std::size_t first_index) const;
  /// Returns nothing if the ratio is not linear along the triangle. `sun_normal_lux`: the sun that
  /// reaches it.
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
