#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/models/placed_model.h"
#include "compositor/surfaces/affected_triangles.h"
#include "compositor/surfaces/material_table.h"
#include "compositor/surfaces/sun_facing_triangles.h"
#include "compositor/surfaces/surface_buffers.h"
#include "compositor/surfaces/visibility_buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// A scene's lit surfaces in the renderer's memory, each where its model stands now. Needs a
/// current OpenGL context; move-only.
class SceneSurfaces {
 public:
  SceneSurfaces() = default;
  /// Without surfaces until SetLit(). Errors as UploadTextures().
  static Result<SceneSurfaces> Create(const std::vector<PlacedModel>& scene);

  /// As Composer::SetLight() and Composer::MoveModel().
  Result<void> SetLit(const std::vector<LitMesh>& lit);
  void Move(int placed_model, const Mat3& linear, Vec3 translation_m);

  /// For shadow maps: of everything, and of the phantoms alone.
  std::span<const shadows::ShadowCaster> casters() const { return casters_.all; }
  std::span<const shadows::ShadowCaster> phantom_casters() const { return casters_.phantoms; }
  const shadows::Box& object_bounds() const { return casters_.object_bounds; }
  const shadows::Box& bounds() const { return casters_.bounds; }

  /// What of the phantoms' light objects may change depends on.
  struct SunOnPhantoms {
    SunWindow window;
    bool whole = false;          ///< The sun's light in all of it, also where no object hides it.
    glm::vec3 normal_lux{0.0F};  ///< Linear Rec.709.

    /// Whether nothing that is seen changes from one to the other.
    bool IsAsGoodAs(const SunOnPhantoms& other) const;
  };
  /// Tells what of the phantoms the objects may change under `sun`. Errors (system): no memory.
  Result<void> SortPhantoms(const SunOnPhantoms& sun);
  /// Draws the numbers that the phantoms' triangles have in triangles(), of those that change;
  /// `program` of shaders/triangle_id.frag is in use.
  void DrawPhantoms(const gl::GlProgram& program) const;
  const VisibilityBuffer& triangles() const { return phantoms_.buffer; }
  /// AffectedTriangles::MaxLinearChangeFarFrom() of all phantoms.
  float MaxLinearChangeFarFrom(const glm::vec3& eye_m) const;
  /// Tells which of the objects' triangles may face the sun, `to_sun` zero: none, and where the
  /// objects stand. Errors (system): no memory.
  Result<void> SortObjects(const glm::vec3& to_sun);
  /// Draws the numbers that the objects' triangles have in object_triangles(), with their textures;
  /// `program` of shaders/triangle_id.frag is in use.
  void DrawObjects(const gl::GlProgram& program) const;
  const VisibilityBuffer& object_triangles() const { return objects_.buffer; }
  /// By the values of object_triangles().
  const MaterialTable& object_materials() const { return objects_.materials; }
  /// Some of the objects have textures or alpha.
  bool HasTextures() const { return features_.textures; }
  /// Some mirror their surroundings: a metal or a coat does.
  bool HasGloss() const { return features_.gloss; }
  /// Some have holes or are glass.
  bool HasAlpha() const { return features_.alpha; }
  /// Draws everything with `program`, which is in use: places alone.
  void Draw(const gl::GlProgram& program) const;

 private:
  /// What some of the objects have.
  struct ObjectFeatures {
    bool textures = false, alpha = false, gloss = false;
  };
  struct Textures {
    gl::GlTexture white;
    std::vector<std::vector<gl::GlTexture>> by_model;  // A list a placed model.
  };
  /// The surfaces as they were lit.
  struct LitSurfaces {
    std::vector<SurfaceBuffers> surfaces;
    std::vector<std::uint64_t> geometries;  // LitMesh::geometry.
    std::vector<shadows::Box> bounds;
    std::uint64_t revision = 0;  // The shadow maps follow it.
  };
  /// The phantoms among them, in order.
  struct Phantoms {
    std::vector<AffectedTriangles> triangles;
    VisibilityBuffer buffer;
    std::optional<SunOnPhantoms> sorted_for;  // As SortPhantoms() was called.
  };
  /// The objects among them, in order.
  struct Objects {
    std::vector<SunFacingTriangles> triangles;
    std::vector<std::vector<glm::vec3>> positions;  // Of their vertices, where they were lit.
    VisibilityBuffer buffer;
    MaterialTable materials;
    // The buffer is as the triangles are, the materials are as moved_ is.
    bool are_sorted = false, are_placed = false;
  };
  /// Where the models stand now.
  struct Casters {
    std::vector<shadows::ShadowCaster> all, phantoms;
    shadows::Box object_bounds, bounds;
  };

  /// Whether the surfaces are those of `lit`, so that there is nothing new but their light.
  bool HasSurfacesOf(const std::vector<LitMesh>& lit) const;
  Result<void> SetSurfaces(const std::vector<LitMesh>& lit);
  void PlaceCasters();
  /// What the objects cover of `window` where they stand now.
  SunFootprint FootprintOf(const SunWindow& window) const;
  const Material& MaterialOf(const SurfaceBuffers& surface) const {
    return scene_[surface.placed_model()].model->materials[surface.material()];
  }

  std::vector<PlacedModel> scene_;
  ObjectFeatures features_;
  Textures textures_;
  LitSurfaces lit_;
  std::vector<glm::dmat4> moved_;  // By placed model: marker from where it was lit.
  Phantoms phantoms_;
  Objects objects_;
  Casters casters_;
};

}  // namespace pleinair::compositor
