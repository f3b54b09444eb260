#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "compositor/composer_options.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/sun_footprint.h"
#include "compositor/surfaces/affected_triangles.h"
#include "compositor/surfaces/image_tiles.h"
#include "compositor/surfaces/sun_facing_triangles.h"

namespace pleinair::compositor {

/// Inputs that determine how objects may change the phantoms' light.
struct SunOnPhantoms {
  SunWindow window;
  bool whole = false;  ///< The sun's light may change in the whole window, also beyond the objects'
                       ///< footprint.
  glm::vec3 normal_lux{0.0F};  ///< Linear Rec.709.

  /// Returns whether replacing `other` by this changes nothing visible.
  bool IsAsGoodAs(const SunOnPhantoms& other) const;
};

/// Sorts a scene's triangles by the shading that they need, so that most pixels need little or
/// none. It contains all reductions: without them (DrawReductions::None()), every visible triangle
/// is fully shaded. Reductions pay off on a software renderer. Shading a pixel costs more there
/// than sorting triangles on the CPU.
class DrawReduction {
 public:
  /// Sets the reductions.
  void Use(const DrawReductions& reductions);

  /// Removes all surfaces.
  void Clear();
  void AddPhantom(const LitMesh& phantom);
  void AddObject(const LitMesh& object);
  /// Sets new light for the same triangles. `phantom`: index in the order of addition.
  void SetLight(std::size_t phantom, const LitMesh& mesh, const LightMix& mix = {}) {
    phantoms_[phantom].SetLight(mesh, mix);
  }
  /// Sets another shape for the same triangles. `object`: index in the order of addition.
  void SetShape(std::size_t object, const LitMesh& mesh);
  /// Forces the next SortPhantoms() after light changed or objects moved, whatever the sun.
  void Invalidate() { sorted_for_.reset(); }

  /// Returns whether the phantoms' triangles are sorted for this sun.
  bool AreSortedFor(const SunOnPhantoms& sun) const {
    return sorted_for_ && sun.IsAsGoodAs(*sorted_for_);
  }
  /// Sorts the phantoms' triangles by what the objects may change under `sun`. `objects_moved`: one
  /// entry per object, its transform to marker coordinates from where it was lit.
  void SortPhantoms(const SunOnPhantoms& sun, std::span<const glm::mat4> objects_moved);
  /// Sorts an object's triangles by whether they may face the sun. Returns whether their order
  /// changed. `to_sun`: as SunFacingTriangles::Sort().
  bool SortObject(std::size_t object, const glm::vec3& to_sun);

  /// Returns the tiles of an image that the objects affect.
  /// `objects_moved`: as SortPhantoms().
  AffectedTiles TilesOf(const SceneProjection& image,
                        std::span<const glm::mat4> objects_moved) const;

  /// In the order of addition.
  std::span<const AffectedTriangles> phantoms() const { return phantoms_; }
  std::span<const SunFacingTriangles> objects() const { return objects_; }
  /// Vertex positions where the object was lit. `object`: index in the order of addition.
  std::span<const glm::vec3> object_positions(std::size_t object) const {
    return object_positions_[object];
  }
  /// Max. of AffectedTriangles::MaxLinearChangeFarFrom() over all phantoms.
  float MaxLinearChangeFarFrom(const glm::vec3& eye_m) const;

 private:
  /// The objects' current footprint in `window`.
  SunFootprint FootprintOf(const SunWindow& window, std::span<const glm::mat4> objects_moved) const;

  DrawReductions reductions_;
  std::vector<AffectedTriangles> phantoms_;
  std::vector<SunFacingTriangles> objects_;
  std::vector<std::vector<glm::vec3>> object_positions_;  // Vertex positions where they were lit.
  std::optional<SunOnPhantoms> sorted_for_;
};

}  // namespace pleinair::compositor
