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
#include "compositor/surfaces/sun_facing_triangles.h"

namespace pleinair::compositor {

/// What of the phantoms' light objects may change depends on.
struct SunOnPhantoms {
  SunWindow window;
  bool whole = false;          ///< The sun's light in all of it, also where no object hides it.
  glm::vec3 normal_lux{0.0F};  ///< Linear Rec.709.

  /// Whether nothing that is seen changes from one to the other.
  bool IsAsGoodAs(const SunOnPhantoms& other) const;
};

/// Sorts the triangles of a scene by the shading that they need, so that most pixels get little or
/// none. All reductions are here: a scene without them (DrawReductions::None()) shades every
/// triangle that is seen in full. They pay on a software renderer, where shading a pixel costs more
/// than sorting triangles on the processor.
class DrawReduction {
 public:
  /// Other reductions from now on.
  void Use(const DrawReductions& reductions);

  /// Forgets all surfaces.
  void Clear();
  void AddPhantom(const LitMesh& phantom);
  void AddObject(const LitMesh& object);
  /// Another light on the same triangles; `phantom` in the order they were added.
  void SetLight(std::size_t phantom, const LitMesh& mesh) { phantoms_[phantom].SetLight(mesh); }
  /// The next SortPhantoms() sorts, whatever the sun: light changed or objects moved.
  void Invalidate() { sorted_for_.reset(); }

  /// Whether the phantoms' triangles are sorted for this sun.
  bool AreSortedFor(const SunOnPhantoms& sun) const {
    return sorted_for_ && sun.IsAsGoodAs(*sorted_for_);
  }
  /// Sorts the phantoms' triangles by what the objects may change under `sun`. `objects_moved`: by
  /// object, marker from where it was lit.
  void SortPhantoms(const SunOnPhantoms& sun, std::span<const glm::mat4> objects_moved);
  /// Sorts an object's triangles by whether they may face the sun; returns whether their order
  /// changed. `to_sun`: as SunFacingTriangles::Sort().
  bool SortObject(std::size_t object, const glm::vec3& to_sun);

  /// In the order they were added.
  std::span<const AffectedTriangles> phantoms() const { return phantoms_; }
  std::span<const SunFacingTriangles> objects() const { return objects_; }
  /// AffectedTriangles::MaxLinearChangeFarFrom() of all phantoms.
  float MaxLinearChangeFarFrom(const glm::vec3& eye_m) const;

 private:
  /// What the objects cover of `window` where they stand now.
  SunFootprint FootprintOf(const SunWindow& window, std::span<const glm::mat4> objects_moved) const;

  DrawReductions reductions_;
  std::vector<AffectedTriangles> phantoms_;
  std::vector<SunFacingTriangles> objects_;
  std::vector<std::vector<glm::vec3>> object_positions_;  // Of their vertices, where they were lit.
  std::optional<SunOnPhantoms> sorted_for_;
};

}  // namespace pleinair::compositor
